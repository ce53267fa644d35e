"""Builds the wheel by CMake (PEP 517): pip install ./apps/python needs no other package and no network."""

import base64
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
VERSION = re.search(r"project\(rugosa VERSION ([0-9.]+)", (HERE.parents[1] / "CMakeLists.txt").read_text())[1]
METADATA = f"""Metadata-Version: 2.1
Name: rugosa
Version: {VERSION}
Summary: Rough profiles with a given contact behaviour
Requires-Python: >=3.9
Requires-Dist: numpy
"""


def _build(folder):
    fresh = not (pathlib.Path(folder) / "CMakeCache.txt").exists()  # an existing build keeps its tests
    subprocess.run(["cmake", "-S", str(HERE.parents[1]), "-B", folder, "-DRUGOSA_PYTHON=ON",
                    f"-DPython_EXECUTABLE={sys.executable}", *["-DRUGOSA_TESTS=OFF"] * fresh], check=True)
    subprocess.run(["cmake", "--build", folder, "--target", "rugosa_python", "--parallel",
                    str(os.cpu_count() or 1)], check=True)
    return pathlib.Path(folder) / "python" / "rugosa"


def _bundle(package, folder):
    """Files of the module with the shared libraries that not every Linux system with Python has."""
    module = next(package.glob("_rugosa*.so"))
    found = re.findall(r"^\s*(\S+) => (/\S+)", subprocess.check_output(["ldd", module], text=True), re.MULTILINE)
    of_the_system = re.compile(r"(libc|libm|libdl|librt|libpthread|libgcc_s|libstdc\+\+|libz|ld-linux.*)\.so")
    bundled = {f"rugosa/{module.name}": (module, "$ORIGIN/libraries")}
    bundled |= {f"rugosa/libraries/{name}": (path, "$ORIGIN") for name, path in found if not of_the_system.match(name)}
    files = {}
    for name, (path, places) in bundled.items():
        copy = pathlib.Path(shutil.copy(path, folder))
        subprocess.run(["patchelf", "--set-rpath", places, copy], check=True)
        files[name] = copy.read_bytes()
    return files


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    version = "cp%d%d" % sys.version_info[:2]
    tag = f"{version}-{version}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"
    name = f"rugosa-{VERSION}-{tag}.whl"
    information = f"rugosa-{VERSION}.dist-info"
    # RUGOSA_BUILD names a folder that is kept, which makes the next build quick.
    with tempfile.TemporaryDirectory() as temporary:
        package = _build(os.environ.get("RUGOSA_BUILD", temporary))
        files = {f"rugosa/{file.name}": file.read_bytes() for file in sorted(package.iterdir()) if file.is_file()}
        if shutil.which("patchelf"):
            files |= _bundle(package, temporary)
    files[f"{information}/METADATA"] = METADATA.encode()
    files[f"{information}/WHEEL"] = (f"Wheel-Version: 1.0\nGenerator: rugosa\nRoot-Is-Purelib: false\n"
                                     f"Tag: {tag}\n").encode()
    record = ""
    for path, content in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        record += f"{path},sha256={digest},{len(content)}\n"
    files[f"{information}/RECORD"] = (record + f"{information}/RECORD,,\n").encode()
    with zipfile.ZipFile(pathlib.Path(wheel_directory) / name, "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, content in files.items():
            wheel.writestr(path, content)
    return name


def build_sdist(sdist_directory, config_settings=None):
    raise NotImplementedError("rugosa is built from its repository: pip install ./apps/python")
