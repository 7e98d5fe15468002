from netdesign.outcome import SiteDataError
from netdesign.site.cells.findings import Finding, add_nearest, quote
from netdesign.words.message import say


def test_a_finding_names_place_text_rule_quantity_and_what_is_accepted():
    finding = Finding(
        file="site.xlsx",
        sheet="Nets",
        cell="C14",
        field="snow density [kg/m3]",
        text="0,45O",
        rule=say("number.not_a_number"),
        accepted="100 to 900 kg/m³",
    )
    assert str(finding) == (
        'site.xlsx › Nets › C14: "0,45O" is not a number (snow density [kg/m3]); '
        "accepted: 100 to 900 kg/m³"
    )


def test_an_empty_cell_a_sheet_and_a_file_are_called_so():
    cell = Finding(file="f.xlsx", sheet="Nets", cell="A2", rule=say("cell.empty"))
    sheet = Finding(file="f.xlsx", sheet="Nets", rule=say("nets.no_row"))
    file = Finding(file="f.xlsx", rule=say("csv.no_text"))
    assert str(cell) == "f.xlsx › Nets › A2: the cell is empty"
    assert str(sheet) == "f.xlsx › Nets: the sheet has no net row"
    assert str(file) == "f.xlsx: the file is no text file"


def test_long_text_and_line_breaks_are_shortened_only_in_the_message():
    finding = Finding(
        file="f.xlsx", cell="A1", text="a\n" + "b" * 500, rule=say("cell.too_long")
    )
    assert "\n" not in str(finding)
    assert len(quote(finding.text)) <= 62
    assert len(finding.text) == 502


def test_near_matches_are_suggested_and_far_ones_are_not():
    accepted = say("accepted.text")
    near = add_nearest(accepted, "A52", dict.fromkeys(["A25", "B77"], ""))
    assert str(near) == 'text (nearest: "A25")'
    assert add_nearest(accepted, "Q", {"A25": "", "B77": ""}) is accepted


def test_the_exception_carries_every_finding_and_shows_each_on_a_line():
    findings = [
        Finding(file="f.xlsx", rule=say("book.many_parts", count=n)) for n in range(3)
    ]
    error = SiteDataError(findings)
    assert error.findings == tuple(findings)
    assert str(error).splitlines() == [str(finding) for finding in findings]
    assert error.exit_code == 3
