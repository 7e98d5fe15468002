"""Hook of the build: compiles the core where there is a C compiler.

Else the wheel is pure Python. It runs before the package is installed.
"""

from __future__ import annotations

import contextlib
import importlib.util
import shutil
import sysconfig
import tempfile
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


def load_sources(root: Path) -> Any:
    """``netdesign/core/sources.py``, without the package around it."""
    path = root / "netdesign" / "core" / "sources.py"
    spec = importlib.util.spec_from_file_location("core_sources", path)
    if spec is None or spec.loader is None:
        raise ImportError(str(path))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class CoreBuildHook(BuildHookInterface):  # type: ignore[type-arg]
    """Library in the wheel, or beside its sources for an editable install."""

    _folder: str | None = None

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Compile; without a compiler, or where it fails, all works on NumPy."""
        sources = load_sources(Path(self.root))
        library: Path = sources.LIBRARY
        is_editable = version == "editable"
        if is_editable:
            # of another text, or another machine; one in use is told by its digest
            with contextlib.suppress(OSError):
                library.unlink(missing_ok=True)
        compiler = sources.find_compiler()
        if compiler is None:
            self.app.display_info("no C compiler: the program computes in NumPy")
            return
        if not is_editable:
            self._folder = tempfile.mkdtemp()
        target = Path(self._folder) / library.name if self._folder else library
        fault = sources.compile_core(compiler, target)
        if fault:
            self.app.display_warning(f"the core was not compiled: {fault}")
        elif not is_editable:
            build_data["force_include"][str(target)] = f"netdesign/core/{library.name}"
            build_data["pure_python"] = False
            platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
            build_data["tag"] = f"py3-none-{platform}"

    def finalize(self, *_: object) -> None:
        """Take away what was compiled for the wheel: it has its copy."""
        if self._folder:
            shutil.rmtree(self._folder, ignore_errors=True)
