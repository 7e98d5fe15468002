"""Reader for the tests: what python-docx finds in a document."""

import io
import zipfile

import docx

W = "{http://schemas.openxmlformats.org/wordprocessingml/2006/main}"


def open_word(content):
    return docx.Document(io.BytesIO(content))


def squeeze(text):
    """Text without any blank: where lines break says nothing."""
    return "".join(text.split())


def list_tables(content):
    """Lines of cells of each table; a line over all columns is one cell."""
    return [
        [
            [
                "".join(one.text or "" for one in cell.iter(f"{W}t"))
                for cell in line.tc_lst
            ]
            for line in table._tbl.tr_lst
        ]
        for table in open_word(content).tables
    ]


def list_parts(content):
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        return {name: archive.read(name) for name in archive.namelist()}
