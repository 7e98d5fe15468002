import pytest

from netdesign.outcome import SiteDataError
from netdesign.site.cells.cells import TextFormat
from netdesign.site.reader import read_site

ROWS = """\
row;slope ψ [deg];snow height [m normal];upslope length L [m];net type;\
post spacing b [m]
R1;38,5;2,75;20;N;3,5
R2;40;2,5;20;N;3,5
"""
NETS = """\
net type;effective height D_K [m];net stiffness [kN/m]
N;3,5;9000
"""
PROJECT = """\
item;value;unit
density of the snow;270 to 400;kg/m3
"""


def write(path, text, encoding="utf-8"):
    path.write_bytes(text.encode(encoding))
    return path


def write_all(folder, rows=ROWS, nets=NETS, project=PROJECT, encoding="utf-8"):
    folder.mkdir(exist_ok=True)
    write(folder / "Rows.csv", rows, encoding)
    write(folder / "Net types.csv", nets, encoding)
    write(folder / "Project.csv", project, encoding)
    return folder


def refusal_of(path, text_format=None):
    with pytest.raises(SiteDataError) as caught:
        read_site(path, text_format or TextFormat())
    return str(caught.value)


@pytest.mark.parametrize("delimiter", [";", ",", "\t", "|"])
def test_the_delimiter_of_each_file_is_found(tmp_path, delimiter):
    plain = [x.replace(",", ".").replace(";", delimiter) for x in (ROWS, NETS, PROJECT)]
    site = read_site(write_all(tmp_path / "site", *plain))
    assert [row.snow_thickness for row in site.rows] == [2.75, 2.5]
    assert site.ranges["density"].high == 400.0
    names = {";": "semicolon", ",": "comma", "\t": "tab", "|": "bar"}
    for note in map(str, site.notes):
        assert f"delimiter {names[delimiter]} and the encoding utf-8" in note


def test_decimal_commas_go_with_semicolons_and_in_quotes_with_commas(tmp_path):
    site = read_site(write_all(tmp_path / "site"))
    assert site.rows[0].snow_thickness == 2.75
    quoted = [
        "\n".join(
            ",".join(f'"{cell}"' for cell in line.split(";"))
            for line in one.splitlines()
        )
        for one in (ROWS, NETS, PROJECT)
    ]
    site = read_site(write_all(tmp_path / "quoted", *quoted))
    assert site.rows[0].layout.post_spacing == 3.5


def test_a_folder_of_files_is_a_workbook(tmp_path):
    folder = tmp_path / "site"
    folder.mkdir()
    write(folder / "Combe - Rows.csv", ROWS)
    write(folder / "Types de filets.csv", NETS)
    write(folder / "letter.csv", "Dear;Sir\n")
    site = read_site(folder)
    assert len(site.rows) == 2
    assert any("letter" in note and "not read" in note for note in map(str, site.notes))
    echo = site.rows[0].inputs[1]
    assert (echo.cell, echo.text) == ("Rows!B2", "38,5")


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "cp1252", "utf-16"])
def test_names_survive_every_usual_encoding(tmp_path, encoding):
    """Each file of a folder has its own."""
    nets, rows = (x.replace("N;3,5", "Größe é;3,5") for x in (NETS, ROWS))
    folder = write_all(tmp_path / "site", rows)
    write(folder / "Net types.csv", nets, encoding)
    assert [row.net_height for row in read_site(folder).rows] == [3.5, 3.5]


@pytest.mark.parametrize(
    ("content", "rule"),
    [
        (b"no;known\nheadings;here\n", "has no clear delimiter: semicolon or comma"),
        (b"", "has no clear delimiter"),
        (b"row;slope [deg]\x00;\n", "is no text file"),
        (ROWS.encode() + b'"never closed;1;2\n', "cannot be read as csv"),
        (b"row;slope\n" + b"R;1\n" * 40_001, "has cells filled down to row 40001"),
        (b"row;slope\n" + b";" * 300 + b"1\n", "beyond column GR"),
        (b"row;slope\n" + (b"1;" * 150 + b"\n") * 3000, "holds 450002 cells"),
    ],
)
def test_what_cannot_be_read_is_one_clear_finding(tmp_path, content, rule):
    path = tmp_path / "site.csv"
    path.write_bytes(content)
    message = refusal_of(path)
    assert rule in message
    assert message.count("\n") == 0
