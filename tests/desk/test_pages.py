"""A page: all texts lie on it, none over another, whatever their number."""

import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from suspension_ctrl.desk.pages import PAGE, Block, Picture, fill


def rows(count: int) -> Block:
    return Block(
        "Parts", ["part", "value", "unit"], [[f"spring_{i}", f"{i}.5", "N/mm"] for i in range(count)], "A note."
    )


def page(*contents) -> Figure:
    figure = Figure(figsize=PAGE)
    FigureCanvasAgg(figure)
    fill(figure, *contents)
    return figure


def boxes(figure):
    """Boxes of the texts that are not empty [pixels]."""
    renderer = figure.canvas.get_renderer()
    return [one.get_window_extent(renderer) for one in figure.texts if one.get_text()]


@pytest.mark.parametrize("count", [2, 30, 90])
def test_all_texts_are_on_the_page_and_none_lies_over_another(count):
    figure = page(
        "A title",
        "2026-11-27",
        ["A paragraph. " * 20, rows(count), Picture([lambda axes: axes.plot([0, 1])]), rows(3)],
    )
    found = boxes(figure)
    assert all(figure.bbox.x0 <= one.x0 and one.x1 <= figure.bbox.x1 for one in found)
    assert all(figure.bbox.y0 <= one.y0 and one.y1 <= figure.bbox.y1 for one in found)
    pairs = [(a, b) for i, a in enumerate(found) for b in found[:i]]
    assert not [pair for pair in pairs if pair[0].padded(-1).overlaps(pair[1].padded(-1))]
    plots = [axes.get_window_extent() for axes in figure.axes]
    assert not [one for one in found for plot in plots if one.overlaps(plot)]


def test_a_wide_table_has_smaller_letters_in_the_width_of_the_page():
    wide = Block("Wide", [f"column {i}" for i in range(16)], [["a long cell"] * 16])
    figure = page("A title", "", [wide])
    assert max(one.x1 for one in boxes(figure)) <= figure.bbox.x1


def test_names_are_no_formulas_and_powers_are_raised():
    figure = page("$x^2$ \x1b[0m", "", ["m/s^2"])
    texts = [one.get_text() for one in figure.texts]
    assert texts[0] == r"\$x²\$ \x1b[0m"
    assert "m/s²" in texts


def test_numbers_stand_to_the_right_and_words_to_the_left():
    figure = page("", "", [rows(2)])
    sides = {one.get_text(): one.get_ha() for one in figure.texts}
    assert (sides["1.5"], sides["spring_1"], sides["N/mm"]) == ("right", "left", "left")
