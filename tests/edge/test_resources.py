import pytest

from netdesign.edge.input_files import find_resource


@pytest.mark.parametrize(
    ("folder", "file"),
    [
        ("standards", "nf-p-95-304-style/document.toml"),
        ("templates", "page.html"),
        ("templates", "example_input.toml"),
    ],
)
def test_folders_of_this_installation_are_found(folder, file):
    assert (find_resource(folder) / file).is_file()


@pytest.fixture
def package(tmp_path):
    """An empty package in a folder of its own."""
    place = tmp_path / "lib" / "netdesign"
    place.mkdir(parents=True)
    return place


def test_a_wheel_has_them_inside_and_inside_wins(package):
    """Beside an installed package lies site-packages, where anything may lie."""
    (package.parent / "standards").mkdir()
    (package / "_data" / "standards").mkdir(parents=True)
    inside = package / "_data" / "standards"
    assert find_resource("standards", package) == inside
