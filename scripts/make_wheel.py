#!/usr/bin/env python3
"""A wheel of the built Python module, with the machines and the catalogue in it.

usage: make_wheel.py BUILD OUT   (BUILD: a build tree, such as build/release; run by the Python that the module was built for)

The shared libraries of the CAD kernel and of TBB and fmt are not in it: it is for machines that have those of the distribution that
it was built on, and its tag says no more than linux.
"""

import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]


def version():
    return re.search(r"project\(OpenFlank VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text()).group(1)


def tag():
    python = f"cp{sys.version_info[0]}{sys.version_info[1]}"
    return f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"


def lay_out(build, folder):
    package = folder / "openflank"
    package.mkdir()
    for file in sorted((ROOT / "python/openflank").iterdir()):
        if file.suffix in (".py", ".pyi") or file.name == "py.typed":
            shutil.copy(file, package)
    module = package / ("_core" + sysconfig.get_config_var("EXT_SUFFIX"))
    shutil.copy(build / "python/openflank" / module.name, module)
    subprocess.run(["strip", "--strip-unneeded", module], check=True)
    for name in ("machines", "catalogue"):
        shutil.copytree(ROOT / "share" / name, package / "share/openflank" / name)
    info = folder / f"openflank-{version()}.dist-info"
    info.mkdir()
    for name in ("LICENSE", "NOTICE"):
        shutil.copy(ROOT / name, info)
    info.joinpath("METADATA").write_text(
        f"Metadata-Version: 2.1\nName: openflank\nVersion: {version()}\n"
        "Summary: Flank milling of free-form surfaces: tools, five-axis motions, a judge\nLicense: Apache-2.0\n"
        f"Requires-Python: ==3.{sys.version_info[1]}.*\nRequires-Dist: numpy\n")
    info.joinpath("WHEEL").write_text(f"Wheel-Version: 1.0\nGenerator: openflank\nRoot-Is-Purelib: false\nTag: {tag()}\n")


def main():
    build, out = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as work:
        lay_out(build, pathlib.Path(work))
        subprocess.run([sys.executable, "-m", "wheel", "pack", "--dest-dir", out, work], check=True)


if __name__ == "__main__":
    main()
