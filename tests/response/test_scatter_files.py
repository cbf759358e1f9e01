"""Scatter in problem files: what is read, what is written, and mistakes."""

import re

import pytest

from suspension_ctrl import RideProblem, Scatter, load_problem, load_study, load_vehicle, save_problem

HEAD = """
vehicle = "yuen_ramli_2010"
road = "C"
speed_m_per_s = 20.0
band_Hz = [0.3, 20.0]
measures = ["mean ACC", "q95 SWS", "CVaR90 DTL"]
constraints = ["q95 SWS <= 30mm"]

[bounds]
spring_N_per_m = [10e3, 30e3]
damper_N_s_per_m = [1e3, 4e3]

[scatter]
"""


def written(tmp_path, scatter):
    path = tmp_path / "robust.toml"
    path.write_text(HEAD + scatter)
    return path


@pytest.mark.parametrize(
    ("text", "scatter"),
    [
        ("spring = 0.05\ndamper = [-0.25, 0.0]", Scatter({"spring": 0.05, "damper": (-0.25, 0.0)})),
        ('spring = "5 %"\ndamper = ["-25 %", 0.0]', Scatter({"spring": 0.05, "damper": (-0.25, 0.0)})),
        (
            'samples = 64\nseed = 7\ndistribution = "normal"\nbody_mass = 0.02',
            Scatter({"body_mass": 0.02}, samples=64, seed=7, distribution="normal"),
        ),
    ],
)
def test_a_scatter_is_read_and_written(tmp_path, text, scatter):
    path = written(tmp_path, text)
    problem = load_problem(path)
    assert problem.scatter == scatter
    save_problem(tmp_path / "again.toml", problem)
    assert load_problem(tmp_path / "again.toml") == problem
    assert load_study(path).problem == problem


def test_names_with_dots_are_tables_or_quoted(tmp_path):
    text = HEAD.replace("yuen_ramli_2010", "minaker_half").replace(
        "spring_N_per_m = [10e3, 30e3]\ndamper_N_s_per_m = [1e3, 4e3]", "front.damper_N_s_per_m = [1e3, 4e3]"
    )
    path = tmp_path / "half.toml"
    path.write_text(text + 'front.damper = 0.1\n"rear.damper" = 0.2')
    problem = load_problem(path)
    assert problem.scatter == Scatter({"front.damper": 0.1, "rear.damper": 0.2})
    save_problem(tmp_path / "again.toml", problem)
    assert load_problem(tmp_path / "again.toml") == problem


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("spring = 1.5", ":14: scatter.spring must leave values above zero, 0.05 for 5 %, got 1.5"),
        ("spring = 0.05\nsamples = 0", ":15: scatter.samples must be a whole number >= 1, got 0"),
        ("sprang = 0.05", ":13: scatter must be one of spring, damper, tyre_stiffness, "),
        ("samples = 5", ":13: scatter must have a tolerance by name, one at least, got none"),
    ],
)
def test_mistakes_are_told_with_their_line(tmp_path, text, message):
    path = written(tmp_path, text)
    with pytest.raises(ValueError, match=re.escape(message)):
        load_problem(path)


def test_a_robust_measure_without_scatter_is_a_mistake(tmp_path):
    path = tmp_path / "robust.toml"
    path.write_text(HEAD.replace("[scatter]", ""))
    with pytest.raises(ValueError, match="scatter must be given for mean ACC, got none"):
        load_problem(path)


def test_a_problem_of_the_program_is_written(tmp_path):
    file = load_vehicle("jian_2022_full")
    problem = RideProblem(
        file.vehicle,
        load_problem(written(tmp_path, "spring = 0.1")).road,
        speed=20.0,
        bounds=file.bounds,
        band=(0.3, 20.0),
        measures=["mean ACC", "CVaR90 DTL front"],
        scatter={"spring": 0.05, "tyre_stiffness": (-0.1, 0.05)},
    )
    save_problem(tmp_path / "full.toml", problem)
    assert load_problem(tmp_path / "full.toml") == problem
