"""Reads site workbooks for commands; ``netdesign init``, ``netdesign map``."""

from __future__ import annotations

import shlex
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from netdesign.addon_table import OF_ROWS
from netdesign.commands.options import (
    take_options,
)
from netdesign.commands.running import UsageRefusal, speak, tell, write_outputs
from netdesign.edge.input_files import explain_with_file
from netdesign.outcome import OutputError, SiteDataError
from netdesign.words.message import say

if TYPE_CHECKING:
    from netdesign.site.cells.cells import TextFormat
    from netdesign.site.model import Site


def open_site(path: Path, asked: Mapping[str, Any]) -> Site:
    """Read a site; with ``annotate`` also write its copy, whether refused or not.

    ``asked`` are options of the command line: delimiter, decimal_mark, annotate, force,
    net_types, and instead, texts that are read in the place of those of some cells.

    Raises
    ------
    SiteDataError
        With all findings; the copy is written before.
    OutputError
        If the copy is in the way of another file.
    """
    from netdesign.edge.output import require_free
    from netdesign.site.reader import read_site

    text_format, annotate = build_text_format(asked), asked.get("annotate")
    library, instead = asked.get("net_types"), asked.get("instead") or {}
    read = partial(read_site, path, text_format, instead, net_types=library)
    if annotate is None:
        return read()
    if annotate.suffix.casefold() != ".xlsx":
        raise UsageRefusal(say("usage.annotate_xlsx", path=str(annotate)))
    if annotate.absolute() == path.absolute():
        raise UsageRefusal(say("usage.annotate_other"))
    require_free([annotate], overwrite=asked["force"])
    try:
        site = read()
    except SiteDataError as error:
        _write_copy(path, error, asked)
        raise
    _write_copy(path, site, asked)
    return site


def require_source(site_file: Path | None, asked: Mapping[str, Any]) -> None:
    """Refuse a command without a site, or with one beside the example.

    Raises
    ------
    UsageRefusal
        Says what to give.
    """
    if asked["example"] == (site_file is not None):
        raise UsageRefusal(say("usage.site_or_example"))


def read_asked_site(site_file: Path | None, asked: Mapping[str, Any]) -> Site:
    """Read the site by the options of a command; the example is a workbook, too.

    Raises
    ------
    UsageRefusal
        Of a cell that is replaced, and that nothing reads.
    """
    if site_file is None:
        with temporary_example() as path:
            return read_asked_site(path, asked)
    site = open_site(site_file, asked)
    bare = {**asked, "annotate": None}
    require_effect(
        asked.get("instead") or {},
        lambda cells: open_site(site_file, {**bare, "instead": cells}),
    )
    return site


def choose_rows(site: Site, ids: Sequence[str]) -> Site:
    """Site with the named net rows; with all rows where none is named."""
    row_ids = tuple(row.id for row in site.rows)
    unknown = tuple(row_id for row_id in ids if row_id not in row_ids)
    if unknown:
        raise UsageRefusal(say("usage.no_row", rows=unknown, given=row_ids))
    return site.take_rows(ids) if ids else site


def build_text_format(asked: Mapping[str, Any]) -> TextFormat:
    """Declared form of a file's text, by the options of a command."""
    from netdesign.site.cells.cells import TextFormat
    from netdesign.site.lists.list_map import MARKS

    mark = MARKS[asked.get("decimal_mark") or ""]
    return TextFormat(delimiter=asked.get("delimiter") or "", decimal_mark=mark)


def require_effect(instead: Mapping[str, str], read: Callable[..., Site]) -> None:
    """Refuse replaced cells that are never read: outputs would claim a change.

    Raises
    ------
    UsageRefusal
        Naming the first of them.
    """
    from dataclasses import replace

    def read_bare(cells: Mapping[str, str]) -> Site | None:
        """Site without the notes on replaced cells; None if the site is refused."""
        try:
            site = read(cells)
        except SiteDataError:  # another cell needs the cell that is left out
            return None
        rows = (
            replace(row, inputs=tuple(replace(e, derivation=None) for e in row.inputs))
            for row in site.rows
        )
        # what no check reads is no part of the comparison either
        of_addons = {
            key: site.of_addons[key] for key in site.of_addons if key in OF_ROWS
        }
        bare = replace(site, what_if=(), rows=tuple(rows), findings=(), notes=())
        return replace(bare, of_addons=of_addons)

    whole = read_bare(instead) if instead else None
    for cell in instead:
        others = {key: text for key, text in instead.items() if key != cell}
        if read_bare(others) == whole:
            raise UsageRefusal(say("what_if.no_effect", cell=cell))


@contextmanager
def temporary_example() -> Iterator[Path]:
    """Write the built-in example to a temporary workbook.

    Raises
    ------
    OutputError
        If there is no room or no place for it.
    """
    import tempfile

    from netdesign.site.template.office_workbook import write_site_workbook

    try:
        place = tempfile.TemporaryDirectory()
    except OSError as error:
        raise OutputError(
            say("output.no_temporary_folder", cause=explain_with_file(error))
        ) from error
    with place as folder:
        path = Path(folder) / "example.xlsx"
        write_site_workbook(path, example=True)
        yield path


def _write_copy(
    path: Path, read: Site | SiteDataError, asked: Mapping[str, Any]
) -> None:
    from netdesign.site.cells.findings import Finding
    from netdesign.site.template.annotate import annotate_workbook

    findings = [finding for finding in read.findings if isinstance(finding, Finding)]
    form, copy = build_text_format(asked), asked["annotate"]
    try:
        content = annotate_workbook(path, findings, form, speak())
    except SiteDataError as error:
        tell(say("finding.no_copy", reason=error.message), err=True)
        return
    write_outputs(copy.parent, {copy.name: content}, asked)


@click.command()
@click.argument("site_file", type=click.Path(path_type=Path, dir_okay=False))
@take_options("init")
def init(site_file: Path, **asked: Any) -> None:
    """Write an input workbook to fill in.

    \b
    netdesign init site.xlsx
    netdesign init chantier.xlsx --language fr
    netdesign init site.xlsx --with parts,tests
    netdesign init example.xlsx --example
    """
    from netdesign.site.template.office_workbook import WITH, write_site_workbook

    if site_file.suffix.lower() != ".xlsx":
        raise UsageRefusal(say("usage.init_suffix", file=str(site_file)))
    more = [*filter(None, map(str.strip, (asked["more"] or "").split(",")))]
    unknown = tuple(sheet for sheet in more if sheet not in WITH)
    if unknown:
        raise UsageRefusal(say("usage.init_with", sheets=unknown, known=tuple(WITH)))
    write_site_workbook(
        site_file,
        example=asked["example"],
        overwrite=asked["force"],
        language=asked["language"],
        more=more,
    )
    tell(say("cli.wrote", path=str(site_file)), err=True)


@click.command(name="map")
@click.argument("site_file", type=click.Path(path_type=Path))
@take_options("map")
def map_headings(site_file: Path, **asked: Any) -> None:
    """Write LIST.map.toml: which headings of a list mean what, to be answered.

    \b
    netdesign map list.xlsx              a list of your own
    netdesign map liste.csv --language fr
    netdesign map list.xlsx --force      again, with the answers given so far
    netdesign map old.xlsx --out new.xlsx

    Every heading has the program's guess, or a question mark with what it may mean and
    its first cells behind it. Change what is wrong, replace each question mark by a
    column of the workbook, or by "ignore". Later runs read the file by themselves.

    With --out a workbook of version 0.1, with a sheet Nets, is written again with Rows
    and Net types; what was done with its cells is listed.
    """
    from netdesign.edge.output import require_free, write_files
    from netdesign.site.lists.ask import is_own_list, write_list_map
    from netdesign.site.lists.list_map import name_map
    from netdesign.site.reader import read_cells

    if asked["out"] is not None:
        _rewrite(site_file, asked["out"], asked)
        return
    place, overwrite = name_map(site_file), asked["force"]
    require_free([place], overwrite=overwrite)
    form = build_text_format(asked)
    read_cells(site_file, form)  # a workbook of version 0.1 is refused
    if not is_own_list(site_file, form):
        raise UsageRefusal(say("usage.map_new", file=str(site_file)))
    text, missing = write_list_map(site_file, form, asked["language"])
    write_files({place: text.encode()}, overwrite=overwrite)
    tell(say("cli.wrote", path=str(place)), err=True)
    tell(
        say("map.missing", count=missing) if missing else say("map.complete"), err=True
    )


def _rewrite(old: Path, new: Path, asked: Mapping[str, Any]) -> None:
    """Write a workbook of version 0.1 again, as one with Rows and Net types."""
    from netdesign.edge.output import require_free, write_files
    from netdesign.site.office.rewrite import read_old, rewrite
    from netdesign.site.template.office_workbook import render_input

    if new.suffix.lower() != ".xlsx" or new.absolute() == old.absolute():
        raise UsageRefusal(say("usage.map_out", file=str(new)))
    require_free([new], overwrite=asked["force"])
    workbook = read_old(old, build_text_format(asked))
    if workbook is None:
        raise UsageRefusal(say("usage.map_not_old", file=str(old)))
    rewritten = rewrite(workbook, asked["language"])
    content = render_input(rewritten.tables, asked["language"], (), rewritten.measures)
    write_files({new: content}, overwrite=asked["force"])
    for message in rewritten.done:
        tell(message)
    tell(say("cli.wrote", path=str(new)), err=True)
    command = shlex.join(["netdesign", "check", str(new)])
    tell(say("rewrite.next", command=command), err=True)
