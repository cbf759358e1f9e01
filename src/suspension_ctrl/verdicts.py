"""The outcome of a comparison in words, made from its tests."""

from collections.abc import Hashable, Mapping, Sequence
from typing import Any

import pandas as pd

from .statistics import SIGNIFICANCE


def verdict(compared: pd.DataFrame, first: str, second: str, value: str) -> str:
    """Return a paragraph on two algorithms: who is ahead at which configurations under each lens.

    Parameters
    ----------
    compared : DataFrame
        From `statistics.pairwise`: rows of one value of which more is better, by lens, population, iterations.
    first, second : str
        The algorithms, in the order in which the table has them.
    value : str
        What is compared, in words.

    Notes
    -----
    An algorithm is ahead where Holm's p-value is below 0.05 and the effect is not negligible; otherwise there is
    no difference.
    """
    pairs = compared[(compared["first"] == first) & (compared["second"] == second)]
    if pairs.empty:
        return f"There are no runs of both {first} and {second} to compare."
    sentences = [_sentence(str(lens), part, first, second) for lens, part in pairs.groupby("lens", sort=False)]
    return f"{value}, {first} against {second}. " + " ".join(sentences)


def _sentence(lens: str, pairs: pd.DataFrame, first: str, second: str) -> str:
    outcomes: dict[str, list[str]] = {}
    for pair in pairs.to_dict("records"):
        where = f"N = {pair['population']} and {pair['iterations']} iterations ({_numbers(pair)})"
        outcomes.setdefault(_outcome(pair, first, second), []).append(where)
    return f"At {lens} " + "; ".join(f"{who} for {_listed(where)}" for who, where in outcomes.items()) + "."


def _outcome(pair: Mapping[Hashable, Any], first: str, second: str) -> str:
    if pair["p_holm"] >= SIGNIFICANCE or pair["size"] == "negligible":
        return "there is no difference that the runs can show"
    return f"{first if pair['a12'] > 0.5 else second} is ahead"


def _numbers(pair: Mapping[Hashable, Any]) -> str:
    medians = f"medians {pair['median_first']:.4f} and {pair['median_second']:.4f}"
    p = "p < 0.001" if pair["p_holm"] < 0.001 else f"p = {pair['p_holm']:.3f}"
    return f"{medians}, {p}, A12 = {pair['a12']:.2f}, {pair['size']}"


def _listed(parts: Sequence[str]) -> str:
    return parts[0] if len(parts) == 1 else ", ".join(parts[:-1]) + " and " + parts[-1]
