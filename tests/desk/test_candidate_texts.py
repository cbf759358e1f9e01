"""Parts of a table of candidates in mm and kN, four digits, and a page of Markdown."""

import pandas as pd

from suspension_ctrl import Problem
from suspension_ctrl.desk.candidate_texts import decimals_of, markdown, parts_of

TABLE = pd.DataFrame(
    {
        "name": ["present design", "knee"], "spring [N/m]": [22e3, 9e3], "SWS [m]": [0.0287, 0.00998],
        "DTL [N]": [1365.2, 999.99], "SWS change [%]": [0.0, -65.2], "DTL change [%]": [0.0, float("nan")],
        "heave [Hz]": [1.2, 0.9], "heave damping [-]": [0.3, 0.2], "largest travel in 1 km [m]": [0.09, 0.03],
        "active": ["", "spring at its lower bound"],
    },
    index=pd.RangeIndex(2, name="candidate"),
)  # fmt: skip
PROBLEM = Problem(
    evaluate=lambda x: x, lower=(0,), upper=(1e5,), objectives=("SWS", "DTL"), variables=("spring",),
    units={"spring": "N/m", "SWS": "m", "DTL": "N"},
)  # fmt: skip


def test_every_column_is_in_one_part():
    parts = parts_of(PROBLEM, TABLE)
    assert {title: list(part) for title, part in parts.items()} == {
        "Candidates": ["no.", "name", "SWS [m]", "DTL [N]"],
        "Changes against the present design": ["no.", "SWS [%]", "DTL [%]"],
        "Designs and largest travel": ["no.", "spring [N/m]", "largest travel in 1 km [m]"],
        "Modes, without dampers, and damping ratios": ["no.", "heave [Hz]", "heave damping [-]"],
    }
    proof = {"residual": [float("nan"), 1e-13], "price of DTL [m per N]": [float("nan"), -2e-6]}
    assert list(parts_of(PROBLEM, TABLE.assign(**proof)).items())[-1][0] == (
        "Prices: change of SWS by the values of other measures and by limits"
    )
    page = markdown("Car", parts_of(PROBLEM, TABLE.assign(**proof)), [])
    assert "price of DTL [mm per kN]" in page
    assert "-2 |" in page
    plain = parts_of(PROBLEM, TABLE[["name", "spring [N/m]", "SWS [m]", "DTL [N]", "active"]])
    assert list(plain) == ["Candidates", "Designs"]


def test_a_page_of_markdown_has_the_sentences_and_the_parts_in_mm_and_kn():
    page = markdown("My *car*", parts_of(PROBLEM, TABLE), ["SWS <= 12 mm does nothing."])
    assert page.startswith("# My \\*car\\*\n\n- SWS &lt;= 12 mm does nothing.\n\n## Candidates\n\n|")
    rows = [[cell.strip() for cell in line.split("|")] for line in page.splitlines()]
    assert ["", "no.", "name", "SWS [mm]", "DTL [kN]", ""] in rows
    assert ["", "1", "knee", "9.98", "1.000", ""] in rows
    assert ["", "1", "-65.2", "", ""] in rows
    assert "nan" not in page


def test_many_modes_stand_in_rows():
    """Of a car with wheels of its own, seven: their columns would stand in blocks."""
    names = ["heave", "roll", "pitch", "front wheel hop", "rear wheel hop"]
    modes = {f"{name} [Hz]": [1.0 + n, 2.0 + n] for n, name in enumerate(names)}
    modes |= {f"{name} damping [-]": [0.1 * n, 0.2 * n] for n, name in enumerate(names)}
    parts = parts_of(PROBLEM, TABLE.drop(columns=["heave [Hz]", "heave damping [-]"]).assign(**modes))
    frequencies, ratios = (part for title, part in parts.items() if "by candidate" in title)
    assert frequencies.to_dict("list") == {"frequency of": names, "0": [1.0, 2, 3, 4, 5], "1": [2.0, 3, 4, 5, 6]}
    assert ratios["1"].tolist() == [0.2 * n for n in range(5)]
    assert decimals_of(frequencies) == {"frequency of": 2, "0": 2, "1": 2}
    assert decimals_of(ratios) == {"damping of": 3, "0": 3, "1": 3}
    assert "Modes, without dampers, and damping ratios" not in parts
    assert "| heave           | 1.00 | 2.00 |" in markdown("A car", parts, [])
