"""The page of a run in a notebook."""

from base64 import b64encode
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from ... import checks
from ...response.certificates import Certificate
from ...response.problem import RideProblem
from ..candidate_table import Present, candidates, design_of
from ..candidate_texts import parts_of
from ..decision import Decision
from ..study_files import StudyFile
from .page_file import page_of

if TYPE_CHECKING:
    from ...search.run import Run

_HEIGHT = 900  # px


@dataclass(frozen=True)
class Page:
    """A page for a browser, which a notebook shows.

    Parameters
    ----------
    title : str
    html : str
        The whole page: one file without network.
    """

    title: str
    html: str = field(repr=False)

    def _repr_html_(self) -> str:
        """Return the page in a frame; its content is a part of the address, nothing is fetched."""
        content = b64encode(self.html.encode()).decode("ascii")
        style = f'style="width: 100%; height: {_HEIGHT}px; border: 0"'
        return f'<iframe src="data:text/html;base64,{content}" {style}></iframe>'


def explore(
    problem: RideProblem,
    run: "Run",
    *,
    present: Present | None = None,
    title: str = "Designs",
    certificates: Sequence[Certificate] = (),
) -> Page:
    """Return the page of a run: its front in linked plots, and sliders that move measures and curves.

    It is the page that `suspension-ctrl report` writes. A notebook shows it; elsewhere its ``html`` may be saved.

    Parameters
    ----------
    problem : RideProblem
    run : Run
        The result of a search on the problem.
    present : mapping of str to float, or (d,) array_like, optional
        The present design, beside which others are shown.
    title : str
        Title of the page.
    certificates : sequence of Certificate
        Designs of the problem driven in time by `certify`: the page shows their simulated values.

    Returns
    -------
    Page
        With ``title`` and ``html``.

    Raises
    ------
    ValueError
        If the run is of another problem or has no feasible design, or about the present design or a certificate.

    Examples
    --------
    >>> from pathlib import Path
    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("yuen_ramli_2010")
    >>> problem = sc.RideProblem(file.vehicle, sc.Iso8608Road("C"), speed=20.0, bounds=file.bounds)
    >>> run = sc.minimise(problem, sc.Nsga2(population=40), iterations=10, seed=1)
    >>> page = sc.explore(problem, run, present=file.setting, title="My car")
    >>> page
    Page(title='My car')
    >>> _ = Path("report.html").write_text(page.html, encoding="utf-8")
    """
    checks.of_kind("problem", problem, RideProblem)
    checks.listed("certificates", certificates)
    for one in certificates:
        checks.of_kind("each of certificates", one, Certificate)
        design_of(problem, one.design, "design of a certificate")
    table = candidates(problem, run, present=present)
    own = (
        {} if present is None else dict(zip(problem.variables, design_of(problem, present).tolist(), strict=True))
    )
    study = StudyFile(problem=problem, name=title, present=own)
    decision, sections = Decision(problem, run, run, table), {"Candidates": parts_of(problem, table)}
    return Page(title, page_of(study, decision, problem.describe(), sections, certificates=certificates))
