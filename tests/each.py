"""Cases of a property in one test: an item of the suite costs more than most."""

import functools
import inspect
from collections.abc import Iterable

import pytest


def each(names, cases):
    """As ``pytest.mark.parametrize``, in one test that tells every case that fails.

    Cases that take long to find may be given as a function.
    """
    arguments = [name.strip() for name in names.split(",")]
    known = list(cases) if isinstance(cases, Iterable) else None

    def decorate(function):
        signature = inspect.signature(function)

        @functools.wraps(function)
        def try_all(**fixtures):
            failed, tried = [], list(cases()) if known is None else known
            assert tried, "a property of no case is no property"
            for case in tried:
                given = case if len(arguments) > 1 else (case,)
                values = dict(zip(arguments, given, strict=True))
                try:
                    function(**fixtures, **values)
                except (Exception, pytest.fail.Exception) as error:  # noqa: BLE001
                    error.add_note(f"in the case {values}")
                    failed.append(error)
            if failed:
                told = f"{len(failed)} of {len(tried)} cases fail"
                raise BaseExceptionGroup(told, failed)

        kept = [
            one for name, one in signature.parameters.items() if name not in arguments
        ]
        try_all.__signature__ = signature.replace(parameters=kept)
        return try_all

    return decorate
