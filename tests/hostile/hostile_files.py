"""Files made to harm: each by its name, with the command that is to refuse it.

All content comes from a seeded generator, so that nothing packs better than a bomb
that hides: the ratio of packing alone does not give these away.
"""

from __future__ import annotations

import random
import re
import zipfile
from collections.abc import Callable
from pathlib import Path

SHEET = "xl/worksheets/sheet2.xml"  # Rows of the example workbook
_DIGITS = random.Random(20261121)

CHECK = ("check", "--dry-run")
SOLVE, REPORT = ("solve",), ("report",)


def digits(most: int = 99) -> bytes:
    return b"%d" % _DIGITS.randrange(most)


def repeat(count: int, write: Callable[[int], bytes]) -> bytes:
    return b"".join(write(number) for number in range(count))


def change_part(base: Path, path: Path, part: str, change: object) -> None:
    """Copy of a workbook with one part changed, or added."""
    with zipfile.ZipFile(base) as archive:
        parts = {name: archive.read(name) for name in archive.namelist()}
    parts[part] = change(parts.get(part, b"")) if callable(change) else change
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        for name, content in parts.items():
            archive.writestr(name, content)


def fill_sheet(body: bytes) -> Callable[[bytes], bytes]:
    def change(xml: bytes) -> bytes:
        start, rest = xml.split(b"<sheetData>", 1)
        rest = rest.split(b"</s", 1)[1].partition(b">")[2]
        return start + b"<sheetData>" + body + b"</sheetData>" + rest

    return change


def list_workbooks() -> dict[str, tuple[str, object]]:
    """Changed part and its change, by name."""
    cell = b'<c r="%b"><v>1</v></c>'
    deep = [b"<r%d>" % (k % 7) for k in range(40_000)]
    last = b'<row r="%d"><c r="XFD%d"><v>%b</v></c></row>'
    cells = repeat(900_000, lambda _: b"<c><v>" + digits() + b"</v></c>")
    text = repeat(4_000_000, lambda _: digits() + b" ")
    rows = {
        "cells-in-one-row": b"<row>" + cells + b"</row>",
        "empty-rows": repeat(1_200_000, lambda _: b'<row s="' + digits() + b'"/>'),
        "attributes": b"<row " + repeat(1_500_000, lambda k: b'a%x="" ' % k) + b"/>",
        "deep": b"".join(deep) + b"".join(deep[::-1]).replace(b"<", b"</"),
        "one-cell": b'<row r="1"><c t="inlineStr"><is><t>' + text
        + b"</t></is></c></row>",
        "last-column": repeat(1999, lambda k: last % (k + 1, k + 1, digits(10**6))),
        "last-row": b'<row r="1048576">%b</row>' % (cell % b"A1"),
    }  # fmt: skip
    fonts = repeat(900_000, lambda _: b'<xf fontId="' + digits(2) + b'"/>')
    strings = repeat(900_000, lambda _: b"<si><t>" + digits() + b"</t></si>")
    merged = repeat(40_000, lambda _: b'<mergeCell ref="A1:B' + digits() + b'"/>')
    merged = b"<mergeCells>" + merged + b"</mergeCells>"
    twice = rb'(<c r="B6"[^>]*>)(<v>[0-9.]+</v></c>)'
    return {name: (SHEET, fill_sheet(body)) for name, body in rows.items()} | {
        "styles": ("xl/styles.xml", put(b"</cellXfs>", fonts)),
        "strings": ("xl/sharedStrings.xml", put(b"</sst>", strings)),
        "merged": (
            SHEET,
            lambda xml: xml.replace(b"</sheetData>", b"</sheetData>" + merged),
        ),
        "cell-twice": (SHEET, lambda xml: re.sub(twice, rb"\1\2\1\2", xml, count=1)),
        "entity": (SHEET, lambda xml: b'<!DOCTYPE x [<!ENTITY a "b">]>' + xml),
        "nested-zip": ("xl/worksheets/sheet99.xml", bytes(40 * 2**20)),
    }


def put(end: bytes, content: bytes) -> Callable[[bytes], bytes]:
    """Put content before an end of a part."""
    return lambda xml: xml.replace(end, content + end)


def write_all(folder: Path, base: Path) -> dict[str, tuple[str, ...]]:
    """Write every file; the command for each, by the file's name."""
    commands: dict[str, tuple[str, ...]] = {}
    for name, (part, change) in list_workbooks().items():
        path = folder / f"{name}.xlsx"
        change_part(base, path, part, change)
        commands[path.name] = CHECK
    commands |= dict.fromkeys(_write_archives(folder, base), CHECK)
    commands |= dict.fromkeys(_write_texts(folder), (*CHECK, "--delimiter", ";"))
    commands |= dict.fromkeys(_write_scenes(folder), SOLVE)
    commands |= dict.fromkeys(_write_studies(folder), REPORT)
    return commands


def _write_archives(folder: Path, base: Path) -> list[str]:
    sound = base.read_bytes()
    (folder / "truncated.xlsx").write_bytes(sound[: len(sound) // 2])
    (folder / "crc.xlsx").write_bytes(_spoil_checksum(sound))
    (folder / "encrypted.xlsx").write_bytes(_mark_encrypted(sound))
    (folder / "old.xlsx").write_bytes(b"\xd0\xcf\x11\xe0" + bytes(2000))
    (folder / "really-xlsx.csv").write_bytes(sound)
    for name, method in (("bzip2", zipfile.ZIP_BZIP2), ("lzma", zipfile.ZIP_LZMA)):
        with zipfile.ZipFile(folder / f"{name}.xlsx", "w", method) as archive:
            archive.writestr("xl/workbook.xml", bytes(100 * 2**20))
    _hide_size(folder / "bzip2.xlsx", 100 * 2**20)
    _hide_size(folder / "lzma.xlsx", 100 * 2**20)
    with zipfile.ZipFile(folder / "paths.xlsx", "w") as archive:
        archive.writestr("../../outside.xml", "<x/>")
        archive.writestr("/etc/outside.xml", "<x/>")
    (folder / "loop.xlsx").symlink_to("loop.xlsx")
    names = ["truncated", "crc", "encrypted", "old", "bzip2", "lzma", "paths", "loop"]
    return [*(f"{name}.xlsx" for name in names), "really-xlsx.csv"]


def _spoil_checksum(content: bytes) -> bytes:
    place = content.index(b"PK\x01\x02") + 16
    return content[:place] + bytes(4) + content[place + 4 :]


def _mark_encrypted(content: bytes) -> bytes:
    spoilt = bytearray(content)
    for mark, offset in ((b"PK\x03\x04", 6), (b"PK\x01\x02", 8)):
        spoilt[spoilt.index(mark) + offset] |= 1
    return bytes(spoilt)


def _hide_size(path: Path, size: int) -> None:
    """Let an archive declare a thousand bytes for its part."""
    content = path.read_bytes().replace(
        size.to_bytes(4, "little"), (1000).to_bytes(4, "little")
    )
    path.write_bytes(content)


def _write_texts(folder: Path) -> list[str]:
    contents = {
        "wide.csv": b"id;" + b"ab;" * 1_390_000,
        "wide-8.csv": b"id;" + b"ab;" * 2_700_000,
        "empty-cells.csv": b"id;slope" + b";" * 4_000_000,
        "lines.csv": b"id;slope\n" + b"\n" * 4_000_000,
        "field.csv": b"id;slope\n" + b"x" * 4_000_000,
        "huge-signs.csv": b"id;" + b"ab;" * 1_300_000 + "\U0001f600".encode(),
        "quote.csv": b'id;"slope\n' + b"a;b\n" * 1000,
    }
    for name, content in contents.items():
        (folder / name).write_bytes(content)
    many = folder / "many"
    many.mkdir()
    for number in range(20):
        (many / f"{number}.csv").write_bytes(b"a" * 4_000_000)
    return [*contents, "many"]


def _write_scenes(folder: Path) -> list[str]:
    texts = {
        "brackets.toml": "a = " + "[" * 100_000,
        "closed.toml": "a = " + "[" * 50_000 + "]" * 50_000,
        "tables.toml": "a = " + "{b=" * 50_000,
        "points.toml": ".".join("a" * 100_000) + " = 1\n",
        "digits.toml": "a = " + "9" * 5000,
        "huge.toml": "".join(f"a{k} = {k}\n" for k in range(500_000)),
        "faults.toml": "".join(f"a{k} = {k}\n" for k in range(15_000)),
        "nan.toml": "[slope]\nangle_deg = nan\n",
    }
    for name, text in texts.items():
        (folder / name).write_text(text)
    (folder / "endless.toml").symlink_to("/dev/zero")
    return [*texts, "endless.toml"]


def _write_studies(folder: Path) -> list[str]:
    def rows(item: str, count: int) -> str:
        return '{"rows": [' + ",".join([item] * count) + "]}"

    keys = ",".join(f'"k{k}":1' for k in range(190))
    texts = {
        "brackets.json": "[" * 1_000_000,
        "objects.json": '{"a":' * 1_000_000,
        "keys.json": "{" + ",".join(f'"k{k}": 1' for k in range(500_000)) + "}",
        "numbers.json": rows("1.5", 15_000_000),
        "fewer-numbers.json": rows("1.5", 790_000),
        "empty-objects.json": rows("{}", 149_000),
        "unknown-keys.json": rows("{" + keys + "}", 73_000),
        "small-objects.json": rows("{}", 19_000),
        "text.json": '{"notes": ["' + "ab " * 10_000_000 + '"]}',
        "digits.json": '{"schema": ' + "9" * 1_000_000 + "}",
        "twice.json": '{"verdict": "fail", "verdict": "pass"}',
    }
    for name, text in texts.items():
        (folder / name).write_text(text)
    (folder / "endless.json").symlink_to("/dev/zero")
    return [*texts, "endless.json"]
