"""The tree is the data flow: import-linter holds its layers, names hide nothing, functions are short."""

import ast
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import suspension_ctrl

PACKAGE = Path(suspension_ctrl.__file__).parent
MODULES = sorted(path for path in PACKAGE.rglob("*.py") if path.name != "__init__.py")

ROOMS = {
    *("checks", "compiled", "compiled_verbs", "datafiles", "documents", "escaping", "quantities", "schema"),
    *("tables", "threads"),
    *("commands", "desk", "paper", "response", "roads", "search", "study", "vehicles"),
}

PUBLIC = {
    "FlexibleBody", "FullCar", "HalfCar", "Payload", "Plant", "QuarterCar", "RigidBodies", "RollGeometry", "Seat",
    "VehicleFile", "load_vehicle", "save_vehicle", "load_property", "save_property", "damper_figure",
    "load_system", "save_system",
    "BilinearDamper", "BumpStop", "Damper", "DigressiveDamper", "Friction", "Inerter", "MeasuredStiffness",
    "PowerDamper", "ReboundStop", "Rubber", "Spring", "TableDamper", "TableSpring", "parallel", "series",
    "Constant", "Exponential", "Iso8608Road", "Isotropic", "MeasuredRoad", "PowerLawRoad", "Profile", "Tabulated",
    "TwoSlopeRoad", "load_road", "save_road", "ProfileWarning", "load_profile", "save_profile",
    "road_of_iri",
    "Chirp", "Cleat", "Plank", "Pothole", "Ramp", "RigChirp", "RigSine", "Sine", "SpeedBump", "Step",
    "TrapezoidalBump",
    "A8", "ACC", "DLC", "DTL", "MSDV", "SEAT", "TotalValue", "VDV",
    "FrontLoadTransfer", "Limit", "LoadCase", "Measure", "Peak", "RideProblem",
    "Bottoming", "DamperPower", "LargestPeak", "Lift", "Topping", "time_in_zones", "RollDamping",
    "ModeDamping", "ModeFrequency",
    "RollGradient", "RootSumSquare", "SWS", "Term", "exposure", "exposure_by_axis",
    "international_roughness_index", "load_problem",
    "save_problem", "certify", "correlate", "correlation_figure", "LiftOffWarning",
    "linearised", "response_psds", "ride", "simulate",
    "UnitSlipWarning", "weighted_rms", "weighting",
    "SearchSettings", "StudyFile", "load_study", "save_study",
    "FailureWarning", "Gamultiobj", "InfeasibleWarning", "MoeadDra", "Nsga2", "Problem", "ReferenceFront", "Run",
    "Sampling", "minimise", "non_dominated", "Study", "as_pymoo", "as_scipy",
    "candidates", "knee", "pick", "attainable", "attainable_figure", "attained", "skyhook",
    "CVaR", "Mean", "Quantile", "Scatter", "robustness", "robustness_figure", "sensitivity", "sensitivity_figure",
    "explore", "export", "supplier_sheet", "vehicle_file",
    "pareto_front", "refine",
}  # fmt: skip

COMMANDS = {"commands/exposure.py", "commands/ride.py", "commands/weighting.py"}
"""Modules named after the function whose results they print: they are what a user types."""

STANDARD_NAMES = {"search/trace.py"}
"""A module that bears the name of one of the standard library, by design: a search leaves a trace."""


def name_of(module: Path) -> str:
    return module.relative_to(PACKAGE).as_posix()


def lint(folder: Path) -> subprocess.CompletedProcess:
    program = (
        "import sys; sys.path.insert(0, 'src'); from importlinter.cli import lint_imports; "
        "sys.exit(lint_imports(no_cache=True))"
    )
    return subprocess.run([sys.executable, "-c", program], cwd=folder, capture_output=True, text=True)


@pytest.fixture(scope="module")
def copy(checkout, tmp_path_factory) -> Path:
    """A copy of the tree in which the layers hold."""
    folder = tmp_path_factory.mktemp("copy")
    shutil.copytree(checkout / "src", folder / "src", ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(checkout / "pyproject.toml", folder)
    done = lint(folder)
    assert done.returncode == 0, done.stdout
    return folder


@pytest.mark.parametrize(
    ("module", "line"),
    [
        ("roads/road.py", "from ..response import measures"),
        ("roads/road.py", "from ..vehicles import cars"),
        ("search/operators.py", "from suspension_ctrl.vehicles import cars"),
        ("search/operators.py", "import suspension_ctrl.study.lenses"),
        ("study/lenses.py", "import suspension_ctrl.paper.experiment"),
        ("study/lenses.py", "from ..roads import road"),
        ("response/problem.py", "from ..search.nsga2 import Nsga2"),
        ("desk/choosing.py", "from ..paper import experiment"),
        ("paper/tables.py", "def late():\n    from suspension_ctrl.commands import bode"),
        ("checks.py", "from .quantities import Real"),
    ],
)
def test_a_broken_layer_is_seen(copy, module, line):
    path = copy / "src" / "suspension_ctrl" / module
    before = path.read_text(encoding="utf-8")
    path.write_text(f"{before}\n{line}\n", encoding="utf-8")
    done = lint(copy)
    path.write_text(before, encoding="utf-8")
    assert done.returncode == 1, done.stdout
    assert "BROKEN" in done.stdout


def test_rooms_are_those_of_the_design():
    found = {path.stem for path in PACKAGE.iterdir() if path.suffix == ".py" or (path / "__init__.py").exists()}
    assert found == ROOMS | {"__init__"}


def test_public_names():
    assert set(dir(suspension_ctrl)) == set(suspension_ctrl.__all__) == PUBLIC
    for name in PUBLIC:
        assert getattr(suspension_ctrl, name).__name__ == name
    assert not hasattr(suspension_ctrl, "nowhere")


def test_importing_the_package_imports_next_to_nothing():
    program = "import sys, suspension_ctrl; print(*(name.split('.')[0] for name in sys.modules))"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    found = set(done.stdout.split()) - sys.stdlib_module_names
    assert {"suspension_ctrl", "__main__"} & found
    assert not found & {"control", "deap", "matplotlib", "moocore", "numba", "numpy", "pandas", "scipy"}


def test_no_module_hides_a_function_or_the_standard_library():
    exported = {name for name in PUBLIC if not isinstance(getattr(suspension_ctrl, name), type)}
    assert {name_of(path) for path in MODULES if path.stem in exported} <= COMMANDS
    hidden = {name_of(path) for path in MODULES if path.stem in sys.stdlib_module_names}
    assert hidden == STANDARD_NAMES


def code_lines(function: ast.FunctionDef, text: str) -> int:
    """Number of lines that are neither docstring nor blank nor comment."""
    inside = range(function.lineno, function.end_lineno + 1)
    if ast.get_docstring(function) is not None:
        inside = [n for n in inside if not function.body[0].lineno <= n <= function.body[0].end_lineno]
    lines = text.splitlines()
    return sum(1 for n in inside if lines[n - 1].strip() and not lines[n - 1].strip().startswith("#"))


def test_no_function_is_longer_than_40_lines():
    long = set()
    for path in MODULES:
        text = path.read_text(encoding="utf-8")
        functions = [node for node in ast.walk(ast.parse(text)) if isinstance(node, ast.FunctionDef)]
        long |= {f"{name_of(path)}: {f.name}" for f in functions if code_lines(f, text) > 40}
    assert long == set()


def test_every_module_has_a_test_file(checkout):
    tests = checkout / "tests"
    untested = {
        name_of(path)
        for path in MODULES
        if not (tests / path.relative_to(PACKAGE).parent / f"test_{path.stem}.py").exists()
    }
    assert not untested


def private_names(tree: ast.AST) -> set[str]:
    """Private names of other modules and objects that a module reads, imports or patches."""
    found = set()
    for node in ast.walk(tree):
        match node:
            case ast.ImportFrom(names=names):
                found |= {alias.name for alias in names}
            case ast.Attribute(value=ast.Name(id="self" | "cls" | "other")):
                pass
            case ast.Attribute(attr=name):
                found.add(name)
            case ast.Call(func=ast.Attribute(attr="setattr"), args=[_, ast.Constant(value=str(name)), *_]):
                found.add(name)
    return {name for name in found if name.startswith("_") and not name.endswith("_")} - PUBLIC_NAMES


PUBLIC_NAMES = {"_asdict", "_fields", "_make", "_replace", "_exit", "_optimize_final_module"}
"""Methods that all named tuples have, `os._exit`, and what code libraries of numba override: not private."""


@pytest.mark.parametrize("room", ["src", "scripts", "benchmarks", "tests"])
def test_no_private_name_of_another_module_is_touched(checkout, room):
    found = {
        f"{path.relative_to(checkout)}: {name}"
        for path in (checkout / room).rglob("*.py")
        for name in private_names(ast.parse(path.read_text(encoding="utf-8")))
    }
    assert found == set()
