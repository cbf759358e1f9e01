"""The Monte Carlo of linearisation in a short form: the bars by the same roads, on which sampling cancels."""

import pandas as pd

import monte_carlo


def test_a_vehicle_is_within_the_bars_of_its_equivalent_on_the_same_roads():
    """One minute: each value within 5, 6, 5 and 10 % of the equivalent's."""
    table = pd.DataFrame(monte_carlo.errors(1.0, 3, "750 bump")).set_index("measure")
    assert list(table.index) == list(monte_carlo.SHARES)
    assert (table["same roads [%]"].abs() <= [100 * share for share in monte_carlo.SHARES.values()]).all()
    assert (table["error [%]"].abs() < 5 + 2 * table["95 % [+-%]"]).all()
    assert table.met["mean travel"]


def test_equivalents_are_those_of_the_design():
    found = monte_carlo.equivalents().set_index("vehicle")["c_eq [N s/m]"]
    assert found[list(monte_carlo.DAMPERS)].round().tolist() == [1500, 1500, 1301, 1258, 1563, 1057]
    assert len(found) == 6 + 2 * len(monte_carlo.CARS)
