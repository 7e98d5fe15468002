from netdesign.outcome import SiteDataError
from netdesign.site.cells.findings import Finding
from netdesign.words.message import say


def test_a_finding_names_place_text_rule_quantity_and_what_is_accepted():
    finding = Finding(
        file="site.xlsx",
        sheet="Rows",
        cell="C14",
        field="snow density [kg/m3]",
        text="0,45O",
        rule=say("number.not_a_number"),
        accepted="100 to 900 kg/m³",
    )
    assert str(finding) == (
        'site.xlsx › Rows › C14: "0,45O" is not a number (snow density [kg/m3]); '
        "accepted: 100 to 900 kg/m³"
    )


def test_the_exception_carries_every_finding_and_shows_each_on_a_line():
    findings = [
        Finding(file="f.xlsx", rule=say("book.many_parts", count=n)) for n in range(3)
    ]
    error = SiteDataError(findings)
    assert error.findings == tuple(findings)
    assert str(error).splitlines() == [str(finding) for finding in findings]
    assert error.exit_code == 3
