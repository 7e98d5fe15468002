"""Size of the package: it is held here, and the figures only ever go down."""

import ast
import tokenize

from tests.each import each
from tests.sources import PACKAGE, parse_package

LONGEST_FUNCTION = 45  # from def to end, without its docstring
LONGEST_MODULE = 500
# Of the day, to be lowered with every cut: modules, and lines with code (no blank,
# comment, docstring or import). The core is all but the add-ons.
MODULES, LINES = 307, 41_010
CORE_MODULES, CORE_LINES = 233, 29_676

Function = ast.FunctionDef | ast.AsyncFunctionDef


def find_docstring(node: ast.AST) -> ast.stmt | None:
    has_one = isinstance(node, ast.Module | ast.ClassDef | Function)
    return node.body[0] if has_one and ast.get_docstring(node) is not None else None


def span(node: ast.stmt | None) -> set[int]:
    return set(range(node.lineno, node.end_lineno + 1)) if node else set()


def count_lines(name: str) -> int:
    with (PACKAGE / name).open("rb") as file:
        tokens = list(tokenize.tokenize(file.readline))
    bare = {"COMMENT", "NL", "NEWLINE", "INDENT", "DEDENT", "ENDMARKER", "ENCODING"}
    lines: set[int] = set()
    for token in tokens:
        if tokenize.tok_name[token.type] not in bare:
            lines.update(range(token.start[0], token.end[0] + 1))
    for node in ast.walk(parse_package()[name]):
        is_import = isinstance(node, ast.Import | ast.ImportFrom)
        lines -= span(node if is_import else find_docstring(node))
    return len(lines)


@each("name", parse_package)
def test_no_function_and_no_module_is_too_long(name):
    long = {
        f"{name}:{node.name}"
        for node in ast.walk(parse_package()[name])
        if isinstance(node, Function)
        and len(span(node) - span(find_docstring(node))) > LONGEST_FUNCTION
    }
    assert not long
    length = len((PACKAGE / name).read_text(encoding="utf-8").splitlines())
    assert length <= LONGEST_MODULE


def test_the_package_does_not_grow():
    lines = {name: count_lines(name) for name in parse_package()}
    core = [name for name in lines if not name.startswith("addons/")]
    assert len(lines) <= MODULES
    assert sum(lines.values()) <= LINES
    assert len(core) <= CORE_MODULES
    assert sum(map(lines.__getitem__, core)) <= CORE_LINES
