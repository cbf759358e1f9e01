"""The tree is the data flow: each module imports only from the ranks before its own."""

import ast
from pathlib import Path

import suspension_ctrl

PACKAGE = Path(suspension_ctrl.__file__).parent
LIBRARY = {"checks", "datafiles", "files", "environment", "terminal"}
PHYSICS = {
    "signals",
    "assembly",
    "modes",
    "vehicles",
    "cars",
    "mounted",
    "toml_tables",
    "vehicle_files",
    "plant_tables",
    "measured_plants",
    "isotropy",
    "coherence",
    "random_roads",
    "roads",
    "profiles",
    "measured_roads",
    "csv_tables",
    "road_tables",
    "road_files",
    "roughness",
    "weightings",
    "quadrature",
    "responses",
    "simulation",
    "exposure",
    "ports",
    "strut_loop",
    "strut_solve",
    "strut_blocks",
    "handling",
    "measures",
    "constraints",
    "cases",
    "scores",
    "judges",
    "objectives",
}
SEARCH = {
    "problems",
    "operators",
    "decomposition",
    "selection",
    "sorting",
    "feasibility",
    "deap_adapter",
    "optimisers",
    "indicators",
    "traces",
}
MEETING = {
    "paper",
    "optimum",
    "problem_files",
    "references",
    "stores",
    "experiments",
    "clusters",
    "study",
    "lenses",
    "statistics",
    "verdicts",
    "tables",
    "figures",
    "comparison_figures",
}
ALLOWED = {
    **{room: {"checks"} for room in LIBRARY},
    **{room: PHYSICS | {"checks", "datafiles"} for room in PHYSICS},
    **{room: SEARCH | {"checks"} for room in SEARCH},
    **{room: MEETING | PHYSICS | SEARCH | {"checks", "datafiles", "files"} for room in MEETING},
}


def room(path: Path) -> str:
    return path.relative_to(PACKAGE).parts[0].removesuffix(".py")


def imported(path: Path) -> set[str]:
    """Rooms of the package that a module imports."""
    depth = len(path.relative_to(PACKAGE).parts)
    nodes = [
        n for n in ast.walk(ast.parse(path.read_text())) if isinstance(n, ast.ImportFrom) and n.level == depth
    ]
    modules = [n.module.split(".")[0] if n.module else alias.name for n in nodes for alias in n.names]
    return set(modules)


def test_imports_point_one_way():
    for path in PACKAGE.rglob("*.py"):
        if path.name == "__init__.py" and path.parent == PACKAGE:
            continue
        assert imported(path) <= ALLOWED[room(path)], path


def test_every_module_has_its_place():
    rooms = {room(path) for path in PACKAGE.rglob("*.py")} - {"__init__"}
    assert rooms == LIBRARY | PHYSICS | SEARCH | MEETING


def test_public_names():
    assert suspension_ctrl.__all__ == [
        *("FlexibleBody", "FullCar", "Gamultiobj", "HalfCar", "InfeasibleWarning", "Iso8608Road", "LoadCase"),
        *(
            "MeasuredPlant",
            "MeasuredRoad",
            "MoeadDra",
            "Nsga2",
            "Payload",
            "PowerLawRoad",
            "Problem",
            "QuarterCar",
        ),
        *("RideProblem", "RollGeometry", "Run", "Sampling", "Seat", "TwoSlopeRoad", "minimise", "simulate"),
        *("weighting",),
    ]
    assert all(hasattr(suspension_ctrl, name) for name in suspension_ctrl.__all__)
