import pytest

from netdesign import __version__
from netdesign.commands import doctor


def test_the_doctor_names_versions_and_finds_the_program_sound(call):
    ended = call("doctor")
    assert ended.code == 0
    lines = ended.out.splitlines()
    shown = {line[8:32].strip(): line[32:] for line in lines}
    assert all(line.startswith("ok ") for line in lines)
    assert shown["netdesign"] == __version__
    assert {"numpy", "OMP_NUM_THREADS", "BLAS", "solver"} <= set(shown)
    assert shown["site workbook"].endswith("8 net rows")


def test_the_doctor_says_where_the_store_is_and_how_large(call, monkeypatch, tmp_path):
    monkeypatch.setattr(doctor, "_list_versions", list)
    monkeypatch.setattr(doctor, "_solve_small_scene", lambda: "")
    monkeypatch.setattr(doctor, "_round_trip_example", lambda: "")
    place = tmp_path / "Wächte" / "cases.sqlite"
    monkeypatch.setenv("NETDESIGN_STORE", str(place))
    assert f"{place}: not begun yet" in call("doctor").out
    place.parent.mkdir()
    place.write_bytes(bytes(2_340_000))
    assert f"{place}: 2.3 MB" in call("doctor").out


@pytest.mark.parametrize("broken", ["_solve_small_scene", "_round_trip_example"])
def test_a_fault_is_told_and_ends_with_5(call, monkeypatch, broken):
    def fail():
        raise RuntimeError("out of order")

    monkeypatch.setattr(doctor, broken, fail)
    ended = call("doctor")
    assert ended.code == 5
    (fault,) = [line for line in ended.out.splitlines() if line.startswith("FAULT")]
    assert "RuntimeError: out of order" in fault
