from dataclasses import replace

from netdesign.outcome import Verdict
from netdesign.report.difference import compare_studies, write_difference
from tests.report.build_study import build_study


def changes_of(old, new):
    return {(one.area, one.row, one.what): (one.old, one.new) for one in
            compare_studies(old, new)}  # fmt: skip


def test_a_study_does_not_differ_from_itself():
    study = build_study()
    later = replace(study.provenance, started="2027-01-01", command="again")
    assert compare_studies(study, replace(study, provenance=later)) == []


def test_verdicts_governing_checks_and_inputs_are_told():
    old = build_study()
    row = old.rows[0]
    worst = max(row.checks, key=lambda check: check.utilisation or 0.0)
    failed = replace(worst, verdict=Verdict.FAIL, utilisation=1.25)
    checks = [failed if check is worst else check for check in row.checks]
    inputs = [replace(row.inputs[0], value=99.0), *row.inputs[1:]]
    changed = replace(row, verdict=Verdict.FAIL, checks=checks, inputs=inputs)
    new = replace(old, rows=[changed, *old.rows[1:]])
    found = changes_of(old, new)
    assert found["verdict", row.id, "verdict"] == ("pass", "fail")
    before, after = found["governing", row.id, "utilisation"]
    assert (before, after) == (worst.utilisation, 1.25)
    name = f"{row.inputs[0].label} [{row.inputs[0].unit}]".removesuffix(" []")
    assert found["input", row.id, name] == (row.inputs[0].value, 99.0)
    assert {place[1] for place in found} == {row.id}


def test_rows_that_came_or_went_are_told_once():
    old, new = build_study(rows=3), build_study(rows=2)
    gone = old.rows[2]
    found = {place: change for place, change in changes_of(old, new).items()
             if place[1] == gone.id}  # fmt: skip
    assert found == {("verdict", gone.id, "net row"): (str(gone.verdict), None)}
    assert changes_of(new, old)["verdict", gone.id, "net row"][0] is None


def test_project_profile_ranges_and_settings_are_told():
    old = build_study()
    value = replace(old.profile.values[0], value=7.0)
    new = replace(
        old,
        project=replace(old.project, revision="C"),
        profile=replace(old.profile, values=[value, *old.profile.values[1:]]),
        range_inputs=[replace(old.range_inputs[0], value=260.0), *old.range_inputs[1:]],
        provenance=replace(old.provenance, version="9"),
    )
    found = changes_of(old, new)
    assert found["project", "", "revision"] == ("B", "C")
    assert found["settings", "", "version"][1] == "9"
    assert found["range", "", "Density, low [kg/m3]"] == (250.0, 260.0)
    assert [new_value for area, _, what in found if area == "profile"
            for new_value in [found[area, "", what][1]]] == [7.0]  # fmt: skip
    assert len(found) == 4


def test_the_document_and_the_lines_show_the_same_values():
    old = build_study()
    new = replace(old, project=replace(old.project, revision=""))
    (change,) = compare_studies(old, new)
    assert str(change) == "revision: B -> none"
    assert write_difference([change]) == {
        "schema": "netdesign.diff/1",
        "changes": [
            {"area": "project", "row": "", "what": "revision", "old": "B", "new": ""}
        ],
    }
