"""What the words of the choice mean."""

from suspension_ctrl import load_study
from suspension_ctrl.desk.explorer.choice_texts import MEANINGS, choice_texts
from suspension_ctrl.response.measures.measure import Measure


def test_abbreviations_are_explained():
    reading, measures, names = choice_texts(
        load_study("paper").problem, ["least ACC, knee", "between"], present=True
    )
    assert reading == "Less is better in every measure. Changes are against the present design: ▼ better, ▲ worse."
    assert measures.startswith("ACC: discomfort, ")
    assert measures.count(": ") == 3
    assert names == (
        "knee: from there a gain in one measure costs most in the others; "
        "between: between the others along the front."
    )


def test_of_several_load_cases_it_is_told_where_limits_hold():
    reading, measures = choice_texts(load_study("full_car").problem, ["least DLC"], present=False)
    assert reading.endswith("Measures are means over the load cases; limits hold in the worst of them.")
    assert "discomfort: root of the sum of squares of Wk driver_acceleration + " in measures


def test_words_that_are_explained_are_those_of_measures():
    assert set(MEANINGS) <= set(Measure.words)
