"""Whatever is altered in a stored study, the comparison with a new solve finds it."""

import json
import random
from dataclasses import replace

import pytest

from netdesign.addons.evidence.command import find_time_fault, list_versions
from netdesign.checks import Check, load_standard
from netdesign.coupling.scene import SolverSettings
from netdesign.outcome import StudyError
from netdesign.site.cells.cells import TextFormat
from netdesign.site.reader import read_site
from netdesign.study.check_site import check_site
from netdesign.study.document import compute_digest, read_document, write_document
from netdesign.study.record_provenance import (
    build_run,
    list_differences,
    read_text_format,
    record_provenance,
)
from netdesign.study.records import RowStudy, Study
from netdesign.study.row_to_check import CheckRun
from tests.alter_study import alter_leaf, list_leaves
from tests.each import each
from tests.make import write_rows

NOISE = 1e-4  # shares and differences are compared no closer, for other processors


@pytest.fixture(scope="module")
def solved(tmp_path_factory):
    """Site of two net rows that pass, and its study: solved once."""
    path = tmp_path_factory.mktemp("verified") / "site.xlsx"
    write_rows(path, ["R1", "R2"])
    site = read_site(path)
    run = CheckRun(
        settings=SolverSettings(accuracy=0.05), started="2026-01-02T03:04:05+00:00"
    )
    (study,) = check_site(site, [load_standard("nf-p-95-304-style")], run)
    return site, study


@pytest.fixture(scope="module")
def text(solved):
    return write_document(solved[1])


def list_found(document, site, fresh):
    """All that `verify` tells of a study, against a new solve of its inputs."""
    try:
        study = read_document(json.dumps(document))
        run = build_run(study)
    except StudyError as error:
        return [error]
    again = replace(fresh, provenance=record_provenance(site, run))
    found = list_differences(study, again)[1]
    if list_versions(study) != list_versions(again):
        found.append("other versions")
    if find_time_fault(study) or not study.digest:
        found.append("time, or no digest")
    return found


def test_the_study_itself_comes_out_again(solved, text):
    assert list_found(json.loads(text), *solved) == []


@each("declared", [TextFormat(), TextFormat(delimiter=";", decimal_mark=",")])
def test_a_study_names_the_form_of_text_that_took_effect(solved, declared):
    """Not the words of a command: what made the study may have had none."""
    site, study = solved
    run = build_run(study)
    made = record_provenance(replace(site, text_format=declared), run)
    assert read_text_format(made) == declared
    for sign in ("", "ab", '"', "x"):
        altered = replace(made, settings={"delimiter": sign, "decimal_mark": "x"})
        assert read_text_format(altered) == TextFormat()


def read_fields(text):
    """Document without what is written beside the fields, which nobody reads."""
    study = json.loads(text)
    rows = study["rows"]
    of_row = [(check, Check) for row in rows for check in row["checks"]]
    for part, kind in [(study, Study), *((row, RowStudy) for row in rows), *of_row]:
        for key in kind.WRITTEN:
            del part[key]
    return study


def shorten(part):
    """The first members of every list: all names of values, few values."""
    if isinstance(part, dict):
        return {key: shorten(one) for key, one in part.items()}
    return [shorten(one) for one in part[:4]] if isinstance(part, list) else part


def list_draws(text, seed):
    """Studies with one value of each name altered, beside the value's path."""
    draw, whole = random.Random(seed), json.dumps(shorten(read_fields(text)))
    leaves = list_leaves(json.loads(whole))
    named = {tuple(p for p in path if isinstance(p, str)): path
             for path in draw.sample(leaves, len(leaves))}  # fmt: skip
    yield (), read_document(whole)
    for name, path in named.items():
        if name not in (("schema",), ("digest",)):
            document = json.loads(whole)
            if alter_leaf(document, path, draw) > NOISE and (study := read(document)):
                yield name, study


def list_lists(part, path=()):
    """Path of every list of a JSON document that has members."""
    members = part.items() if isinstance(part, dict) else enumerate(part)
    found = [path] if isinstance(part, list) and part else []
    for key, one in members:
        if isinstance(one, dict | list):
            found += list_lists(one, (*path, key))
    return found


def drop(members):
    members.pop()


def double(members):
    members.append(members[0])


def reverse(members):
    members.reverse()


@each("change", [drop, double, reverse])
def test_a_list_with_a_member_less_or_more_or_in_another_order_is_found(text, change):
    """One list of each name, of rows, checks, cases, steps, values and notes."""
    whole = json.dumps(shorten(read_fields(text)))
    fresh = read_document(whole)
    named = {tuple(p for p in path if isinstance(p, str)): path
             for path in list_lists(json.loads(whole))}  # fmt: skip
    assert {("rows",), ("rows", "checks"), ("rows", "cases"), ("notes",)} <= set(named)
    for path in named.values():
        members = document = json.loads(whole)
        for key in path:
            members = members[key]
        before = list(members)
        change(members)
        study = members != before and read(document)
        assert not study or list_differences(study, fresh)[1], path


def read(document):
    """The study of a document; None if it is refused, which is found as well."""
    try:
        return read_document(json.dumps(document))
    except StudyError:
        return None


def test_whatever_is_altered_differs_and_is_under_the_digest(text):
    (_, fresh), *draws = list_draws(text, 172)
    told_beside = {("provenance", key) for key in ("version", "libraries")}
    for name, study in draws:
        _, found = list_differences(study, fresh)
        assert bool(found) is (name[:2] not in told_beside), name
    digests = {compute_digest(one) for _, one in draws}
    assert len(digests - {compute_digest(fresh)}) == len(draws) > 150
