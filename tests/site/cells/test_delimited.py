import pytest

from netdesign.outcome import SiteDataError
from netdesign.site.cells.cells import TextFormat
from netdesign.site.reader import read_site

NETS = """\
id;slope angle [deg];snow thickness [m];upslope length [m];ground law;net height [m];\
net stiffness [kN/m];post spacing [m]
R1;38,5;2,75;20;free;3,5;9000;3,5
R2;40;2,5;20;free;3,5;9000;3,5
"""
RANGES = """\
quantity;low;high
density [kg/m3];270;400
friction angle [deg];15;45
"""


def write(path, text, encoding="utf-8"):
    path.write_bytes(text.encode(encoding))
    return path


def write_both(folder, nets=NETS, ranges=RANGES, encoding="utf-8"):
    folder.mkdir(exist_ok=True)
    write(folder / "Nets.csv", nets, encoding)
    write(folder / "Ranges.csv", ranges, encoding)
    return folder


def refusal_of(path, text_format=None):
    with pytest.raises(SiteDataError) as caught:
        read_site(path, text_format or TextFormat())
    return str(caught.value)


@pytest.mark.parametrize("delimiter", [";", ",", "\t", "|"])
def test_the_delimiter_of_each_file_is_found(tmp_path, delimiter):
    both = [one.replace(",", ".").replace(";", delimiter) for one in (NETS, RANGES)]
    site = read_site(write_both(tmp_path / "site", *both))
    assert [row.snow_thickness for row in site.rows] == [2.75, 2.5]
    assert site.ranges["density"].high == 400.0
    names = {";": "semicolon", ",": "comma", "\t": "tab", "|": "bar"}
    for note in map(str, site.notes):
        assert f"delimiter {names[delimiter]} and the encoding utf-8" in note


@pytest.mark.parametrize(
    ("between", "told"),
    [
        ("[Ranges];;", 'row 4, "Ranges"'),
        ("\nRanges;", 'row 5, "Ranges"'),
        ("Plages", 'row 4, "Plages"'),
        ("\nRagnes", 'row 5, "Ragnes"'),
        ("[whatever]", 'row 4, "whatever"'),
    ],
)
def test_a_second_sheet_in_one_file_is_refused_and_no_line_counts(
    tmp_path, between, told
):
    path = write(tmp_path / "site.csv", f"{NETS}{between}\n{RANGES}")
    message = refusal_of(path)
    assert f"names a second sheet in {told}" in message
    assert "one sheet in each csv file, all of them in a folder" in message


def test_decimal_commas_go_with_semicolons_and_in_quotes_with_commas(tmp_path):
    site = read_site(write_both(tmp_path / "site"))
    assert site.rows[0].snow_thickness == 2.75
    quoted = [
        "\n".join(
            ",".join(f'"{cell}"' for cell in line.split(";"))
            for line in one.splitlines()
        )
        for one in (NETS, RANGES)
    ]
    site = read_site(write_both(tmp_path / "quoted", *quoted))
    assert site.rows[0].layout.post_spacing == 3.5


def test_decimal_commas_between_commas_are_refused(tmp_path):
    path = write(tmp_path / "site.csv", NETS.replace(";", ","))
    text_format = TextFormat(delimiter=",")
    assert "has no heading above it" in refusal_of(path, text_format)


def test_a_folder_of_files_is_a_workbook(tmp_path):
    folder = tmp_path / "site"
    folder.mkdir()
    write(folder / "Combe - Nets.csv", NETS)
    write(folder / "Plages.csv", RANGES)
    write(folder / "letter.csv", "Dear;Sir\n")
    site = read_site(folder)
    assert len(site.rows) == 2
    assert any("letter" in note and "not read" in note for note in map(str, site.notes))
    echo = site.rows[0].inputs[1]
    assert (echo.cell, echo.text) == ("Nets!B2", "38,5")


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "cp1252", "utf-16"])
def test_names_survive_every_usual_encoding(tmp_path, encoding):
    text = NETS.replace("R1", "Rangée 1")
    site = read_site(write_both(tmp_path / "site", text, encoding=encoding))
    assert site.rows[0].id == "Rangée 1"


def test_a_declared_decimal_mark_settles_thousands(tmp_path):
    path = write_both(tmp_path / "site", NETS.replace("R1;38,5", "R1;38,500"))
    assert "is ambiguous: 38.500 or 38500" in refusal_of(path)
    site = read_site(path, TextFormat(decimal_mark=","))
    assert site.rows[0].inputs[1].value == 38.5


@pytest.mark.parametrize(
    ("content", "rule"),
    [
        (b"no;known\nheadings;here\n", "has no clear delimiter: semicolon or comma"),
        (b"", "has no clear delimiter"),
        (b"id;slope angle [deg]\x00;\n", "is no text file"),
        (NETS.encode() + b'"never closed;1;2\n', "cannot be read as csv"),
        (b"id;slope\n" + b"R;1\n" * 40_001, "has cells filled down to row 40001"),
        (b"id;slope\n" + b";" * 300 + b"1\n", "beyond column GR"),
        (b"id;slope\n" + (b"1;" * 150 + b"\n") * 3000, "holds 450002 cells"),
    ],
)
def test_what_cannot_be_read_is_one_clear_finding(tmp_path, content, rule):
    path = tmp_path / "site.csv"
    path.write_bytes(content)
    message = refusal_of(path)
    assert rule in message
    assert message.count("\n") == 0
