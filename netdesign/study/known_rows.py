"""Judged net rows in the store: what decides a row is not solved or judged twice.

A row is judged on its own part of the site. Its name is a digest of that part and of
all else that decides its record, so a record is found only where a new run would make
the same one, byte for byte.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress

from netdesign.checks import Standard
from netdesign.edge.json_text import JsonPart, restore_json
from netdesign.site.model import NetRow, Project, Site
from netdesign.solving.identity import identify_installation
from netdesign.solving.runner import Runner
from netdesign.solving.store import write_parts
from netdesign.study.check_run import CheckRun
from netdesign.study.records import RowStudy
from netdesign.words.message import say

Studies = list[RowStudy]  # of one row, one a profile


def cut_site(site: Site, row: NetRow) -> Site:
    """Part of a site on which one of its rows is judged: the row, and what bears on it.

    What is not listed here decides nothing of a row. The notes of a site, its file, and
    of its project all but the creep law that it accepts stand beside the rows.
    """
    monitoring = tuple(one for one in site.monitoring if one.row_id == row.id)
    return Site(
        project=Project(accepted_law=site.project.accepted_law),
        ranges=site.ranges,
        rows=(row,),
        file_name="",
        sha256="",
        monitoring=monitoring,
        declared=tuple(one for one in site.declared if one.row_id in ("", row.id)),
        winter=site.winter if monitoring else None,
        catalogue=site.catalogue,
    )


def name_rows(
    site: Site, standards: Sequence[Standard], run: CheckRun
) -> dict[str, str]:
    """Names of the records of a site's rows, by the ids of the rows.

    Command, time and number of processes are no part of a name: no record has them.
    A row with a value of a new kind has no name, and is judged every time.
    """
    settings = [run.settings, run.method, run.creep_law]
    names = {}
    with suppress(TypeError):
        shared = write_parts([identify_installation(), settings, list(standards)])
        for row in site.rows:
            text = f"[{shared}, {write_parts(cut_site(site, row))}]"
            names[row.id] = hashlib.sha256(text.encode()).hexdigest()
    return names


def find_rows(
    names: Mapping[str, str], runner: Runner, count: int
) -> dict[str, Studies]:
    """Rows that the store knows, by their ids, under so many profiles each.

    A damaged record is told and left out.
    """
    found = {}
    for row_id, name in names.items():
        texts = runner.find_row(name)
        if texts is None:
            continue
        try:
            pairs = zip(texts[::2], texts[1::2], range(count), strict=True)
            found[row_id] = [_restore(text, values) for text, values, _ in pairs]
        except ValueError:
            path = str(runner.store.path if runner.store else "")
            runner.tell(say("store.row_damaged", path=path, name=name[:12]))
    return found


def keep_rows(
    names: Mapping[str, str],
    rows: Iterable[NetRow],
    judged: Iterable[Studies],
    runner: Runner,
) -> None:
    """Keep the records of some rows; of a run that lost a case or met a fault, none.

    Another run could end otherwise.
    """
    if runner.faults or runner.counts.lost:
        return
    for row, studies in zip(rows, judged, strict=True):
        name = names.get(row.id)
        if name is not None:
            parts = [one.written for one in studies]
            texts = [text for part in parts for text in (part.text, part.values)]
            runner.keep_row(name, texts)


def _restore(text: str, values: str) -> RowStudy:
    """Record of a row, with its text: 2.0 that was written as 2 is written so again.

    Raises
    ------
    ValueError
        If it is none.
    """
    row: RowStudy = restore_json(RowStudy, text)
    vars(row)["written"] = JsonPart(text, values)
    return row
