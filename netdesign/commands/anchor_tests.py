"""``netdesign tests``: pull-out tests planned, and read from their form."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from statistics import fmean
from typing import TYPE_CHECKING, Any

import click

from netdesign.commands.options import (
    DEFAULT_STANDARD,
    refuse_without,
    take_options,
)
from netdesign.commands.report import DEFAULT_FOLDER
from netdesign.commands.running import require_places, write_outputs
from netdesign.commands.usage import tell
from netdesign.words.catalogue import Language, render, round_force_up
from netdesign.words.message import Message, say
from netdesign.words.names import as_given, name

if TYPE_CHECKING:
    from netdesign.checks import Standard
    from netdesign.resistance.pull_out import SingleTest
    from netdesign.site.readings import Row
    from netdesign.study.planned_tests import PlannedTests

_STUDY = f"{DEFAULT_FOLDER}/study.json"
_FORM = "anchor-tests.xlsx"


@click.command(name="tests")
@click.argument("file", type=click.Path(path_type=Path, dir_okay=False))
@take_options("tests")
def anchor_tests(file: Path, **asked: Any) -> None:
    """Plan pull-out tests of a site, or evaluate a form of them.

    \b
    netdesign tests site.xlsx --plan --out form.xlsx
    netdesign tests form.xlsx --standard eurocode

    A plan takes the design forces of a stored study. A form that is filled in gives the
    resistance by three ways, and lines for sheet Tests of the site's workbook.
    """
    if asked["plan"]:
        _write_plan(file, asked["study_file"] or Path(_STUDY), asked)
        return
    refuse_without(("study_file", "out", "force"), "--plan")
    from netdesign.checks import load_standard
    from netdesign.site.template.form import read_form

    rows, still_open = read_form(file)
    profile = load_standard(asked["standard"] or DEFAULT_STANDARD)
    for told in _evaluate(rows, profile):
        tell(told)
    if still_open:
        tell(say("plan.open_tests", count=still_open))
    for line in _list_lines(rows, asked["language"]):
        click.echo(line)


def _write_plan(site_file: Path, study_file: Path, asked: Mapping[str, Any]) -> None:
    from netdesign.commands.stored_study import require_inputs
    from netdesign.outcome import StudyError
    from netdesign.site.template.form import build_form
    from netdesign.study.document import load_study
    from netdesign.study.planned_tests import STEPS, plan_tests

    form, named = asked["out"] or Path(_FORM), asked["standard"]
    require_places(form.parent, [form.name], asked)
    if not study_file.exists():
        raise StudyError(
            say("plan.no_study", study=str(study_file), site=str(site_file))
        )
    study = load_study(study_file)
    own = {"site_file": site_file, "standard": named}
    inputs = require_inputs(study, study_file, own)
    profile = inputs.profile
    planned, open_points = plan_tests(study, inputs.site, profile)
    for told in _describe_plan(planned, profile):
        tell(told)
    for told in open_points:
        tell(told, err=True)
    lines = [
        {"type": one.type_id, "proof_load": round_force_up(one.proof_load)}
        | ({"ground": one.ground} if one.ground else {})
        for one in planned
        for _ in one.rows
    ]
    places = [(row, one.force) for one in planned for row in one.rows]
    content = build_form(lines, places, STEPS, asked["language"])
    write_outputs(form.parent, {form.name: content}, asked)


def _describe_plan(
    planned: Sequence[PlannedTests], profile: Standard
) -> Iterator[Message]:
    from netdesign.checks.schema import TEST_COUNT

    wanted = profile.find(TEST_COUNT)
    if wanted is not None:
        status = name("status", wanted.status)
        yield say("plan.count", count=wanted.value, profile=profile.id, status=status)
    for one in planned:
        yield say(
            "plan.line",
            what=_name_type(one.type_id, one.ground),
            count=len(one.rows),
            load=one.proof_load,
            factor=one.proof_load / one.force,
            force=one.force,
            rows=tuple(dict.fromkeys(one.rows)),
        )
        if one.is_beyond_steel:
            yield say("plan.steel", what=_name_type(one.type_id, one.ground))


def _name_type(type_id: str, ground: str) -> Message:
    if not ground:
        return as_given(type_id)
    from netdesign.site.columns.fields import name_word

    return say("plan.in_ground", type=type_id, ground=name_word("ground", ground))


def _evaluate(rows: Sequence[Row], profile: Standard) -> Iterator[Message]:
    """Resistance of each type and ground by every way, and what is accepted."""
    from netdesign.checks.routes import find_tested_resistance
    from netdesign.resistance.pull_out import PullOutTests
    from netdesign.site.type_lines import read_single

    groups: dict[tuple[str, str], list[SingleTest]] = {}
    for row in rows:
        key = (row["type"].word, row["ground"].word)
        groups.setdefault(key, []).append(read_single(row))
    for (kind, ground), tests in groups.items():
        loads = [one.load for one in tests]
        counted = PullOutTests(
            count=len(tests), least=min(loads), mean=fmean(loads), singles=tuple(tests)
        )
        what = _name_type(kind, ground)
        found = find_tested_resistance(counted, profile, tests[0].source, what)
        held = sum(one.is_held is True for one in tests)
        met = sum(one.is_accepted for one in tests)
        yield say("plan.tested", what=what, count=len(tests), held=held, met=met)
        for route, resistance in found.routes.items():
            way = name("route", route)
            if resistance.value is None:
                reason = resistance.lacks[0]
                yield say("plan.open_route", route=way, reason=reason)
            elif route == found.route:
                yield say("plan.counts", route=way, resistance=resistance.value)
            else:
                yield say("plan.beside", route=way, resistance=resistance.value)


def _list_lines(rows: Sequence[Row], language: Language) -> Iterator[str]:
    """Lines of sheet Tests, with tabs between the cells."""
    from netdesign.site.columns.all_tables import TESTS
    from netdesign.words.catalogue import set_marks

    yield "\t".join(field.heading_for(language) for field in TESTS.fields)
    for row in rows:
        cells = []
        for field in TESTS.fields:
            value = row[field.key].value
            text = "" if value is None else str(value)
            if isinstance(value, float):
                text = set_marks(f"{value:.10g}", language)
            elif text in field.words:
                text = render(field.name_word(text), language)
            cells.append(" ".join(text.split()))
        yield "\t".join(cells)
