"""Writes the Python package of a build as a wheel; by it pip builds one from the sources, too (pyproject.toml).

    write_wheel.py BUILD OUT    prints the path of OUT/swell-VERSION-....whl

The wheel holds the package, libswell, and the libraries that it needs but for the runtimes of C and C++, under names of
their own, lest another package's copies take their place. Scenes go to share/swell of the prefix. The same build and
commit give the same bytes. It needs patchelf, and dpkg, which knows whose licence a library has.
"""

import base64
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time
import zipfile

SOURCE = pathlib.Path(__file__).resolve().parent.parent
RUNTIMES = re.compile(r"(libc|libm|libdl|libpthread|librt|libgcc_s|libstdc\+\+|ld-linux-[\w-]+)\.so\.\d+")
# The newest symbols of Ubuntu 22.04, whose Python takes wheels of manylinux_2_35.
PLATFORM, NEWEST = "manylinux_2_35", {"GLIBC": (2, 35), "GLIBCXX": (3, 4, 30), "CXXABI": (1, 3, 13)}
REQUIRES = "Requires-Python: >=3.9\nRequires-Dist: numpy\n"


def run(*command):
    """What a command prints."""
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit(f"error: {command[0]}, got exit code {done.returncode}, allowed 0")
    return done.stdout


def needed_by(file):
    """The libraries that an object asks for."""
    return re.findall(r"\(NEEDED\).*\[(.*)\]", run("readelf", "-d", file))


def find_libraries(module, build, facts):
    """{name: path} of the libraries that go into the wheel: all that the module needs, and those that these need."""
    found, asking = {}, [module]
    while asking:
        for name in needed_by(asking.pop()):
            if name in found or RUNTIMES.fullmatch(name):
                continue
            path = build / "lib" / name
            if not path.exists():
                path = pathlib.Path(run(*facts["compiler"], f"-print-file-name={name}").strip())
            if not path.is_absolute():
                raise SystemExit(f"error: {name}, got none, allowed one that the linker finds")
            found[name] = path
            asking.append(path)
    return found


def runs_on_platform(files):
    """Whether no object asks for a newer symbol than PLATFORM has."""
    versions = re.findall(r"\b([A-Z]+)_([\d.]+\d)", "".join(run("readelf", "-V", "-W", file) for file in files))
    return all(tuple(map(int, version.split("."))) <= NEWEST[library] for library, version in versions
               if library in NEWEST)


def own_name(library):
    return library.replace(".so", "-swell.so", 1)


def bundle(module, libraries, facts):
    """{name in the wheel: bytes} of the objects, that find each other where they lie."""
    files = {}
    renames = [word for name in libraries for word in ("--replace-needed", name, own_name(name))]
    with tempfile.TemporaryDirectory() as folder:
        for name, path in {module.name: module, **libraries}.items():
            copy = pathlib.Path(folder, name)
            run(facts["strip"], "--strip-unneeded", "-o", copy, path)
            run("patchelf", *renames, copy)  # one change at a time: patchelf 0.14 mixes up the names of several
            if path == module:
                run("patchelf", "--set-rpath", "$ORIGIN/lib", copy)
                files[f"swell/{name}"] = copy.read_bytes()
            else:
                run("patchelf", "--set-soname", own_name(name), copy)
                run("patchelf", "--set-rpath", "$ORIGIN", copy)
                files[f"swell/lib/{own_name(name)}"] = copy.read_bytes()
    return files


def licences(libraries):
    """{file: bytes}: ours, those of what is compiled in, and those of Debian's packages whose libraries go along."""
    files = {"LICENSE": (SOURCE / "LICENSE").read_bytes(), "notices.txt": (SOURCE / "cmake/notices.txt").read_bytes()}
    for name in libraries:
        if not name.startswith("libswell."):
            package = run("dpkg-query", "-S", f"*/{name}").split(":")[0]
            files[f"{package}/copyright"] = pathlib.Path("/usr/share/doc", package, "copyright").read_bytes()
    return {f"licenses/{file}": text for file, text in files.items()}


def commit_time_s():
    """Of all files: SOURCE_DATE_EPOCH, or when the commit was made; outside of a repository the first that zip has."""
    if "SOURCE_DATE_EPOCH" in os.environ:
        return int(os.environ["SOURCE_DATE_EPOCH"])
    commit = subprocess.run(["git", "-C", SOURCE, "log", "-1", "--format=%ct"], stdout=subprocess.PIPE, check=False)
    return int(commit.stdout) if commit.returncode == 0 else 315532800


def write_zip(path, files, record):
    """Files in the order of their names, and after them the record of their hashes."""
    lines = [f"{name},sha256={base64.urlsafe_b64encode(hashlib.sha256(data).digest()).decode().rstrip('=')},{len(data)}"
             for name, data in sorted(files.items())]
    when = time.gmtime(commit_time_s())[:6]
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as wheel:
        for name, data in [*sorted(files.items()), (record, "\n".join([*lines, f"{record},,", ""]).encode())]:
            entry = zipfile.ZipInfo(name, when)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o100755 if ".so" in name else 0o100644) << 16
            wheel.writestr(entry, data)


def write_wheel(build, out):
    """Writes the wheel of a build folder into the folder out: its path."""
    package = build / "python" / "swell"
    module = next(package.glob("_swell.*.so"), None)
    if module is None:
        raise SystemExit(f"error: {package}, got no module, allowed one: it needs pybind11-dev and python3-dev")
    facts = json.loads((build / "python" / "build.json").read_text())
    libraries = find_libraries(module, build, facts)
    python, processor = re.fullmatch(r"_swell\.cpython-(\d+)-(\w+)-linux-gnu\.so", module.name).groups()
    platform = PLATFORM if runs_on_platform([module, *libraries.values()]) else "linux"
    tag = f"cp{python}-cp{python}-{platform}_{processor}"
    named = f"swell-{facts['version']}"
    metadata = f"Metadata-Version: 2.1\nName: swell\nVersion: {facts['version']}\nSummary: {facts['summary']}\n" \
               f"License: BSD-3-Clause\n{REQUIRES}"
    about = {"METADATA": metadata.encode(), **licences(libraries),
             "WHEEL": f"Wheel-Version: 1.0\nGenerator: swell\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()}
    files = {f"swell/{file.name}": file.read_bytes() for file in package.iterdir() if file.is_file() and file != module}
    files |= bundle(module, libraries, facts)
    files |= {f"{named}.data/data/share/swell/{file.relative_to(SOURCE)}": file.read_bytes()
              for file in (SOURCE / "scenes").rglob("*") if file.is_file()}
    files |= {f"{named}.dist-info/{name}": text for name, text in about.items()}
    path = out / f"{named}-{tag}.whl"
    out.mkdir(parents=True, exist_ok=True)
    write_zip(path, files, f"{named}.dist-info/RECORD")
    return path


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """What pip calls (PEP 517); with --config-settings build=FOLDER of a build that is made already."""
    made = (config_settings or {}).get("build")
    build = pathlib.Path(made or SOURCE / "build" / f"wheel-{sys.implementation.cache_tag}").resolve()
    if not made:
        run("cmake", "--preset", "release", "-S", SOURCE, "-B", build, f"-DPython_EXECUTABLE={sys.executable}",
            "-DSWELL_BUILD_APPS=OFF", "-DSWELL_BUILD_TESTS=OFF")
        run("cmake", "--build", build, "--target", "swell_package")
    return write_wheel(build, pathlib.Path(wheel_directory)).name


class UnsupportedOperation(Exception):
    """What PEP 517 has a back end raise."""


def build_sdist(sdist_directory, config_settings=None):
    raise UnsupportedOperation("the sources are given out as a repository")


if __name__ == "__main__":
    print(write_wheel(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])))
