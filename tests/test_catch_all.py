"""Who may catch everything: a bug that is caught is a bug that nobody sees."""

import ast

from tests.sources import walk_package

# House rule: nobody else, since a bug that is caught is a bug that nobody sees.
CATCH_ALL = {
    "outcome.py": "catch_fault",  # every case, whoever solves it
    "cli.py": "_run",
    "edge/output.py": "_exchange",  # undoes, and raises again
    # stops its processes, and raises again
    "evidence/runner.py": "_work_through",
    # counts bugs: that is what it is for
    "evidence/benchmark/attempts.py": "attempt_scene",
    "commands/doctor.py": "_try",  # so is this
}


def list_catch_alls():
    for module, function in walk_package():
        if isinstance(function, ast.FunctionDef):
            for node in ast.walk(function):
                if isinstance(node, ast.ExceptHandler) and is_broad(node.type):
                    yield module, function.name


def is_broad(kind):
    names = kind.elts if isinstance(kind, ast.Tuple) else [kind]
    broad = ("Exception", "BaseException")
    return any(one is None or getattr(one, "id", "") in broad for one in names)


def test_nobody_else_catches_everything():
    assert sorted(list_catch_alls()) == sorted(CATCH_ALL.items())
