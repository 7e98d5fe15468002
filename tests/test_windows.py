"""What Windows lacks is not asked for: tested by taking it away, not on Windows."""

import errno
import fcntl
import subprocess
import sys
from pathlib import Path

import pytest

from netdesign.edge import input_files
from netdesign.edge.input_files import _RemovedError, _require_there
from netdesign.edge.output import require_free, write_files
from netdesign.outcome import OutputError, SiteDataError
from netdesign.site.reader import read_site
from tests.make import write_tiny

POSIX = {
    *("fcntl", "resource", "pwd", "grp", "termios", "tty", "pty", "posix"),
    *("syslog", "readline", "curses"),
}


def test_commands_and_benchmarks_start_without_the_modules_of_posix(tmp_path):
    script = (
        "import sys\n"
        f"for name in {sorted(POSIX - {'posix'})}: sys.modules[name] = None\n"
        "from pathlib import Path\n"
        "import netdesign.cli, netdesign.addons.evidence.benchmark.versions\n"
        "from netdesign.addons.evidence.measurements import Clock\n"
        "with Clock() as clock: sum(range(10**5))\n"
        "assert clock.cpu_s >= 0\n"
    )
    result = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=False
    )
    assert result.stderr == ""
    assert result.returncode == 0


# Locks and files that Excel has open


def test_a_lock_whose_file_was_removed_is_none(tmp_path):
    """Another run removed it after this one had opened it: a third has a new one."""
    path = tmp_path / "lock"
    with path.open("wb") as file:
        _require_there(file.fileno())
        path.unlink()
        with pytest.raises(_RemovedError):
            _require_there(file.fileno())


def test_a_folder_without_locks_is_written_all_the_same(tmp_path, monkeypatch):
    def refuse(*_):
        raise OSError(errno.ENOLCK, "no locks")

    monkeypatch.setattr(fcntl, "flock", refuse)
    write_files({tmp_path / "a": b"1"}, overwrite=False)
    assert (tmp_path / "a").read_bytes() == b"1"


def deny(monkeypatch, place, name):
    """Refuse one way to touch a file, as Windows does while Excel has it open."""
    real = getattr(Path, name)

    def refuse(self, *arguments, **named):
        if self == place:
            raise PermissionError(errno.EACCES, "Permission denied", str(self))
        return real(self, *arguments, **named)

    monkeypatch.setattr(Path, name, refuse)


@pytest.mark.parametrize("lock", ["~${}", ".~lock.{}#"])
def test_a_workbook_open_in_excel_is_to_be_closed(tmp_path, monkeypatch, lock):
    path = tmp_path / "site.xlsx"
    write_tiny(path)
    (tmp_path / lock.format(path.name)).write_bytes(b"owner")
    deny(monkeypatch, path, "open")
    with pytest.raises(SiteDataError) as told:
        read_site(path)
    assert str(told.value) == (
        "site.xlsx: the file is open in another program, such as Excel; accepted: a "
        "workbook that is closed there"
    )


def test_a_workbook_that_may_not_be_read_is_not_said_to_be_open(tmp_path, monkeypatch):
    path = tmp_path / "site.xlsx"
    write_tiny(path)
    deny(monkeypatch, path, "open")
    with pytest.raises(SiteDataError, match="Permission denied"):
        read_site(path)


def test_an_open_report_is_refused_before_any_work(tmp_path, monkeypatch):
    report = tmp_path / "report.xlsx"
    report.write_bytes(b"old")
    (tmp_path / "~$report.xlsx").write_bytes(b"owner")
    deny(monkeypatch, report, "open")
    require_free([report], overwrite=True)  # elsewhere than on Windows it is replaced
    monkeypatch.setattr(input_files, "_holds_open_files", lambda: True)
    with pytest.raises(OutputError, match=r"close it there first: .*report\.xlsx"):
        require_free([report], overwrite=True)


def test_a_report_opened_meanwhile_is_told_and_kept(tmp_path, monkeypatch):
    report = tmp_path / "report.xlsx"
    report.write_bytes(b"old")
    (tmp_path / "~$report.xlsx").write_bytes(b"owner")
    deny(monkeypatch, report, "replace")
    with pytest.raises(OutputError, match=r"Excel: close it there .*report\.xlsx"):
        write_files({report: b"new"}, overwrite=True)
    assert report.read_bytes() == b"old"


def test_a_sharing_violation_is_an_open_file():
    error = PermissionError(errno.EACCES, "in use")
    error.winerror = 32
    assert input_files.is_held(error, Path("report.xlsx"))
