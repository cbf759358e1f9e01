"""Hostile names through every medium: the medium's own reader must show the text and nothing else."""

import csv
import html
import io
import re
import warnings
from collections.abc import Callable
from html.parser import HTMLParser

from matplotlib.cbook import is_math_text
from matplotlib.figure import Figure
from rich.text import Text

from suspension_ctrl import escaping

from .counts import Counts

HOSTILE = (
    "\x1b[31mred\x1b[0m", "\x1b]0;title\x07", "line\nbreak\r", "\u202egnp.exe", "\u2066x\u2069", "a\x00b",
    "\ud800", "[bold]x[/bold]", "$x^2$", "$\\frac{", "a$", "_hidden", "a|b", "<b>x</b>",
    "<script>alert(1)</script>", '"quoted"', "[x](javascript:y)", "*x* _y_ `z`", "=1+1", "+1+1", "-1+1",
    "@SUM(A1)", "=cmd|' /C calc'!A0", "'=1", "\t=1", " =1", "\uff1d1", "\\", "\\input{x}", "50 % & #1 ~ ^", "",
    "C:\\new\\x41",
)  # fmt: skip
_LATEX = {
    "textbackslash": "\\", "textasciitilde": "~", "textasciicircum": "^",
    "textless": "<", "textgreater": ">", "textbar": "|",
}  # fmt: skip


class _Page(HTMLParser):
    """A page that must be text alone."""

    text = ""

    def handle_data(self, data: str) -> None:
        self.text += data

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        _refuse((tag, attrs))


def shown(text: str) -> str:
    """Return the text as every medium shows it, by Python's own escapes."""
    return "".join(c if c.isprintable() else repr(c)[1:-1] for c in text)


def through_terminal(text: str) -> str:
    """Return what a terminal shows."""
    return Text(escaping.terminal(text)).plain


def through_csv(text: str) -> str:
    """Return what comes back from a file of one cell; ValueError where a spreadsheet takes it for a formula."""
    file = io.StringIO()
    csv.writer(file).writerow([escaping.csv(text)])
    ((cell,),) = csv.reader(io.StringIO(file.getvalue()))
    if cell.lstrip()[:1] in {*"=+-@\uff1d"}:
        float(cell)
    return shown(escaping.from_csv(cell))


def through_html(text: str) -> str:
    """Return the text that a parser finds; ValueError if it finds a tag."""
    page = _Page()
    page.feed(escaping.html(text))
    page.close()
    return page.text


def through_markdown(text: str) -> str:
    """Return what is left when escapes are taken back; ValueError if a mark stands without one."""
    found = escaping.markdown(text)
    if bare := set(re.sub(r"\\.", "", found)) & set("<>|*`$"):
        _refuse(bare)
    return html.unescape(re.sub(r"\\([!-/:-@\[-`{-~])", r"\1", found))


def through_latex(text: str) -> str:
    """Return what LaTeX prints; ValueError if a special character stands without its command."""
    found = escaping.latex(text)
    if bare := set(re.sub(r"\\text[a-z]+\{\}|\\.", "", found)) & set("&%$#_{}\\~^<>|"):
        _refuse(bare)
    commands = re.compile(r"\\(text[a-z]+)\{\}|\\(.)")
    return commands.sub(lambda one: _LATEX[one[1]] if one[1] else one[2], found)


def through_figure(text: str) -> str:
    """Return the label that a legend draws; ValueError if it is a formula or hidden."""
    figure = Figure(figsize=(8, 1))
    ax = figure.subplots()
    ax.plot([1, 2], label=escaping.figure(text) + "!")  # an empty name has no label of its own
    legend = ax.legend()
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # a character without a glyph
        figure.savefig(io.BytesIO())
    (label,) = [one.get_text() for one in legend.get_texts()]
    if is_math_text(label):
        _refuse(label)
    found = label.removesuffix("!").replace(r"\$", "$")
    return found.removeprefix(" ") if text.startswith("_") else found


def _refuse(what: object) -> None:
    raise ValueError(f"a reader must show text alone, got {what!r}")


MEDIA: dict[str, Callable[[str], str]] = {
    "terminal": through_terminal, "figure": through_figure, "CSV": through_csv, "Markdown": through_markdown,
    "LaTeX": through_latex, "HTML": through_html,
}  # fmt: skip


def hostile() -> Counts:
    """Send every hostile name through every medium; `differing` counts what is not shown as it is."""
    counts = Counts("hostile names through every medium")
    for medium, through in MEDIA.items():
        for text in HOSTILE:
            if medium == "figure" and text == "\uff1d1":
                continue  # the font has no glyph
            try:
                harmless = through(text) == shown(text)
            except (ValueError, TypeError, UserWarning):
                harmless = False
            counts.judge(f"{text!r} in {medium}", differing=not harmless)
    return counts
