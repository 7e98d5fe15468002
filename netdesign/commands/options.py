"""Options that several commands have, each once; options without effect are refused.

A group of options stands in the order of the help. What a file of defaults holds may
stay without effect until what it belongs to is asked for; what is typed may not.
"""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import click
from click.core import ParameterSource

from netdesign.commands.usage import UsageRefusal, ValueRefusal, tell
from netdesign.words.catalogue import LANGUAGES, Language
from netdesign.words.message import Message, say

Decorator = Callable[..., Any]

DEFAULT_STANDARD = "nf-p-95-304-style"
SETTLING_MODELS = ("delta-snow-ageing", "hs2swe", "delta-snow")  # first: the default
_MOST_PROCESSES = 256
DELIMITERS = {"tab": "\t", "\\t": "\t", "comma": ",", "semicolon": ";"}
_EXAMPLE, _CLUSTER = "--example", "--executor"
_TYPED, _SET = ParameterSource.COMMANDLINE, ParameterSource.ENVIRONMENT


def join(*options: Decorator) -> Decorator:
    """Group of options, in the order of the help."""

    def add(command: Any) -> Any:
        for option in reversed(options):
            command = option(command)
        return command

    return add


def check_delimiter(
    context: click.Context, option: click.Parameter, value: str | None
) -> str:
    """Sign between the columns of a csv file, or its name."""
    sign = DELIMITERS.get(value or "", value or "")
    is_mark = sign == "\t" or (sign.isprintable() and not sign.isalnum())
    if len(sign) > 1 or sign == '"' or not is_mark:
        raise ValueRefusal(say("usage.delimiter", text=sign), context, option)
    return sign


def read_instead(
    context: click.Context | None,
    option: click.Parameter | None,
    texts: Sequence[str],
) -> dict[str, str]:
    """Texts by place, of ``CELL=TEXT``.

    Raises
    ------
    ValueRefusal
        If one has another form, or a cell comes twice.
    """
    from netdesign.site.declared_sheet import split_replacement

    instead: dict[str, str] = {}
    for text in texts:
        found = split_replacement(text)
        if found is None:
            raise ValueRefusal(say("what_if.form", text=text), context, option)
        if found[0] in instead:
            raise ValueRefusal(say("what_if.twice", cell=found[0]), context, option)
        instead[found[0]] = found[1]
    return instead


@dataclass(frozen=True, slots=True, kw_only=True)
class GivenRange:
    """A range as typed, in the engineer's unit; ``count`` is None where not given."""

    low: float
    high: float
    count: int | None


class RangeType(click.ParamType):  # type: ignore[type-arg]  # generic in click 8.5 only
    """``low:high[:n]``; every fault names the text and what is accepted."""

    name = "low:high[:n]"

    def convert(
        self,
        value: object,
        param: click.Parameter | None,
        ctx: click.Context | None,
    ) -> GivenRange:
        """Read a range.

        Raises
        ------
        click.BadParameter
            If it is malformed, reversed or empty.
        """
        if isinstance(value, GivenRange):
            return value
        text = str(value)
        parts = text.split(":")
        try:
            low, high = (float(part) for part in parts[:2])
            count = int(parts[2]) if len(parts) == 3 else None
        except ValueError:
            low = high = math.nan
            count = None
        if len(parts) not in (2, 3) or not (math.isfinite(low) and math.isfinite(high)):
            raise ValueRefusal(say("usage.range_form", text=text), ctx, param)
        if low > high:
            raise ValueRefusal(say("usage.range_reversed", text=text), ctx, param)
        if low == high:
            raise ValueRefusal(say("usage.range_empty", text=text), ctx, param)
        if count is not None and not 2 <= count <= 1000:
            raise ValueRefusal(say("usage.range_samples", text=text), ctx, param)
        return GivenRange(low=low, high=high, count=count)


RANGE = RangeType()
_PATH = click.Path(path_type=Path)
_FILE = click.Path(path_type=Path, dir_okay=False)
_FOLDER = click.Path(path_type=Path, file_okay=False)


def flag(*names: str, **more: Any) -> Decorator:
    """Option without a value."""
    return click.option(*names, is_flag=True, **more)


def share(name: str, low: float, high: float, default: float, text: str) -> Decorator:
    """Option with a number between two limits."""
    kind = click.FloatRange(low, high)
    return click.option(name, type=kind, default=default, show_default=True, help=text)


def choice(name: str, accepted: Sequence[str], text: str, **more: Any) -> Decorator:
    """Option with one of some words, of which the first is the default."""
    more = {"default": accepted[0], "show_default": True, **more}
    return click.option(name, type=click.Choice(accepted), help=text, **more)


def json_option(what: str) -> Decorator:
    """``--json``, as ``as_json``: print something as one document."""
    return flag("--json", "as_json", help=f"Print the {what} as JSON.")


def out_option(text: str, **more: Any) -> Decorator:
    """``--out``: a folder, which need not exist."""
    return click.option("--out", type=_FOLDER, help=text, **more)


def jobs_option(text: str = "Processes [number of cores].", **more: Any) -> Decorator:
    """``--jobs``: how many processes solve; None for one a core."""
    processes = click.IntRange(1, _MOST_PROCESSES)
    return click.option("--jobs", type=processes, help=text, **more)


def accuracy_option(text: str, *, default: float, least: float = 1e-4) -> Decorator:
    """``--accuracy``: a share of a force."""
    return share("--accuracy", least, 0.1, default, text)


def language_option(text: str = "Of what is printed.", **more: Any) -> Decorator:
    """``--language``: English unless told otherwise."""
    return choice("--language", LANGUAGES, text, **more)


def model_option(text: str) -> Decorator:
    """``--model``: settling model of a station's snow."""
    return choice("--model", SETTLING_MODELS, text)


def example_option(text: str) -> Decorator:
    """``--example``: the built-in site."""
    return flag(_EXAMPLE, help=text)


force_option = flag("--force", help="Overwrite existing outputs.")
quiet_option = flag("--quiet", help="No progress, no messages.")
median_option = flag("--median", help="Heights as medians of three days.")

# How many cases are solved: processes, cluster, store.
solving_options = join(
    jobs_option(),
    click.option(
        _CLUSTER,
        default="",
        metavar="dask://HOST:PORT",
        help="Solve on a running Dask cluster [this machine].",
    ),
    click.option(
        "--cache/--no-cache",
        default=True,
        help="Keep finished cases, and use those of earlier runs.",
    ),
)

# How the text of a site file is written.
text_options = join(
    click.option(
        "--delimiter",
        metavar="SIGN",
        callback=check_delimiter,
        help="Between the columns of a csv file, or tab [found out].",
    ),
    click.option(
        "--decimal-mark",
        type=click.Choice(["comma", "point"]),
        help="Of numbers stored as text [judged cell by cell].",
    ),
)

# How a site file is read.
site_options = join(
    text_options,
    click.option(
        "--annotate",
        type=_FILE,
        metavar="OUT.xlsx",
        help="Write the workbook again with every finding at its cell.",
    ),
)

what_if_options = join(
    click.option(
        "--what-if",
        "instead",
        multiple=True,
        metavar="CELL=TEXT",
        callback=read_instead,
        help="Read TEXT in a cell, as Nets.P8=A40; repeatable. The outputs are "
        "marked: not the site as built.",
    ),
    flag(
        "--size",
        help="Find the smallest types of the workbook that mend it, and write "
        "what-if studies with them beside the others.",
    ),
)

FIT_PARAMETERS = {
    "slip": "slip_length",
    "density": "density_factor",
    "height": "height_factor",
    "slack": "slack",
    "friction": "friction_angle",
}

# Noise and surveyed parameters of a fit to measured forces.
fit_options = join(
    flag("--fit", help="Fit to sheet Monitoring."),
    share("--noise", 0.001, 0.5, 0.05, "Noise of each reading, relative."),
    share("--cell-error", 0.0, 0.5, 0.05, "Noise common to all readings of a member."),
    share(
        *("--rope-kelvin", 0.0, 30.0, 5.0),
        "Amplitude of the ropes' daily wave [K]: noise.",
    ),
    click.option(
        "--known",
        multiple=True,
        type=click.Choice(tuple(FIT_PARAMETERS)),
        help="Surveyed: not fitted.",
    ),
)

# Where the files of a stored study are.
origin_options = join(
    click.option(
        "--site",
        "site_file",
        type=_PATH,
        help="Its site file [by its name, beside the study or one folder up].",
    ),
    click.option(
        "--standard",
        metavar="ID",
        help="Its limit profile, or a folder with it [by its id].",
    ),
)

# Which reports are written, and how.
report_options = join(
    click.option("--html/--no-html", default=True, help="Write report.html."),
    click.option("--excel/--no-excel", default=True, help="Write report.xlsx."),
    click.option("--pdf/--no-pdf", default=False, help="Write report.pdf (extra pdf)."),
    click.option(
        "--docx/--no-docx", default=False, help="Write report.docx (extra docx)."
    ),
    click.option(
        "--template",
        type=_PATH,
        metavar="FILE.docx",
        help="Write report.docx into it: its styles, header and footer stay.",
    ),
    click.option(
        "--rows-map",
        type=_FILE,
        metavar="ROWS",
        help="The rows.geojson of `netdesign terrain`: a map of the rows by verdict.",
    ),
    click.option("--csv/--no-csv", default=False, help="Write cases.csv, all cases."),
    choice(
        "--detail",
        ["summary", "full"],
        "Of report.html, report.docx: summary has two pages for the client.",
        default="full",
    ),
    language_option("Of the reports; numbers, symbols and keys stay."),
)


def refuse_without(
    names: Sequence[str], needed: tuple[str, ...], language: Language
) -> None:
    """Refuse options of the command that runs, which belong to one not given.

    Parameters
    ----------
    names : sequence of str
        Of their parameters.
    needed : tuple of str
        Options of which one would give them an effect.
    language : str
        Of the note on variables: they may be there for other runs.

    Raises
    ------
    UsageRefusal
        If one of them was typed.
    """
    _refuse(
        names,
        lambda options: say("usage.idle_without", options=options, needed=needed),
        language,
    )


def refuse_delimiter(*paths: Path | None, language: Language) -> None:
    """Refuse ``--delimiter`` where no csv file is read; None is the example's workbook.

    Raises
    ------
    UsageRefusal
        If it was typed.
    """
    from netdesign.site.cells.spreadsheet import is_text

    if any(path is not None and is_text(path) for path in paths):
        return
    file = _EXAMPLE if paths[-1] is None else paths[-1].name
    _refuse(
        ["delimiter"],
        lambda options: say("usage.idle_in_workbook", options=options, file=file),
        language,
    )


def refuse_jobs(executor: str, language: Language) -> None:
    """Refuse ``--jobs`` beside a cluster, which has its own processes.

    Raises
    ------
    UsageRefusal
        If it was typed.
    """
    if executor:
        _refuse(
            ["jobs"],
            lambda options: say("usage.idle_beside", options=options, other=_CLUSTER),
            language,
        )


def _refuse(
    names: Sequence[str],
    explain: Callable[[tuple[str, ...]], Message],
    language: Language,
) -> None:
    """Refuse options where typed; where variables set them, tell that of these."""
    context = click.get_current_context()
    found = [one for one in context.command.params if one.name in names]
    typed = tuple(
        max(one.opts, key=len) for one in found if _is_from(one, _TYPED, context)
    )
    if typed:
        raise UsageRefusal(explain(typed))
    variables = tuple(
        next(filter(os.environ.get, one.envvar or ()), "")
        for one in found
        if _is_from(one, _SET, context)
    )
    if variables:
        tell(say("cli.note", text=explain(variables)), language, err=True)


def _is_from(
    option: click.Parameter, source: ParameterSource, context: click.Context
) -> bool:
    return context.get_parameter_source(option.name or "") is source
