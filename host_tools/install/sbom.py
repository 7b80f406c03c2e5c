#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The components of the host tools, and the notices of their authors.

    sbom.py DIRECTORY [--anywhere]

Writes sdre-drive.cdx.json (CycloneDX 1.5) and THIRD_PARTY.txt. Programs are those of
components.toml with the versions of Debian's packages on this machine. Python packages are those
of the pinned requirements. The same machine gives the same bytes.

Exit code 1: a package or its notice is not here. With --anywhere, for systems without Debian's
packages, it is left out of both files.
"""

import argparse
import gzip
import json
import re
import subprocess
import sys
from pathlib import Path

import tomllib

ROOT = Path(__file__).resolve().parents[2]
REQUIREMENTS = ("host_tools/python/drive.txt", "host_tools/python/packages.txt")
PINNED = re.compile(r"([A-Za-z0-9._-]+)==([^\s;]+)(?:\s*;[^\\]*)?((?:\s*\\\n\s+--hash=\S+)+)")
LINE = "=" * 78


class MissingError(Exception):
    """A package that is not here."""


def product_version():
    """The version of this project."""
    text = (ROOT / "CMakeLists.txt").read_text()
    return re.search(r"project\(sdre-drive VERSION (\S+)", text)[1]


def components():
    return tomllib.loads(Path(__file__).with_name("components.toml").read_text())["component"]


def package_version(package):
    """Debian's version on this machine."""
    command = ["dpkg-query", "-W", "-f", "${Version}", package]
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    except FileNotFoundError as error:
        raise MissingError("dpkg-query: no such command") from error
    if done.returncode != 0 or not done.stdout:
        raise MissingError(f"{package}: no such package here")
    return done.stdout


def notice(package):
    """The copyright file of a package."""
    directory = Path("/usr/share/doc", package)
    for name, opened in (("copyright", open), ("copyright.gz", gzip.open)):
        if (directory / name).exists():
            with opened(directory / name, "rt", encoding="utf-8") as file:
                return file.read()
    raise MissingError(f"{directory}/copyright: no such file")


def python_packages():
    """{(name, version): sums} of the requirements; each has to be pinned with its sums."""
    found = {}
    for name in REQUIREMENTS:
        text = re.sub(r"^\s*#.*\n", "", (ROOT / name).read_text(), flags=re.M)
        rest = PINNED.sub("", text).strip()
        if rest:
            raise MissingError(f"{name}: not pinned with a sum: {rest.splitlines()[0]}")
        for package, version, sums in PINNED.findall(text):
            found[package, version] = sorted(re.findall(r"sha256:([0-9a-f]{64})", sums))
    return found


def entry_of_package(component, version):
    return {
        "type": "library",
        "bom-ref": f"pkg:deb/debian/{component['package']}",
        "name": component["name"],
        "version": version,
        "purl": f"pkg:deb/debian/{component['package']}@{version}",
        "licenses": [{"expression": component["license"]}],
    }


def entry_of_python(name, version, sums):
    return {
        "type": "library",
        "bom-ref": f"pkg:pypi/{name}@{version}",
        "name": name,
        "version": version,
        "purl": f"pkg:pypi/{name}@{version}",
        "scope": "optional",
        "hashes": [{"alg": "SHA-256", "content": content} for content in sums],
    }


def bill(found):
    """The CycloneDX document of (component, version, notice)."""
    libraries = [entry_of_package(component, version) for component, version, _ in found]
    libraries += [entry_of_python(*key, sums) for key, sums in sorted(python_packages().items())]
    product = {
        "type": "application",
        "bom-ref": "sdre-drive",
        "name": "sdre-drive",
        "version": product_version(),
        "licenses": [{"license": {"id": "MIT"}}],
    }
    return {
        "bomFormat": "CycloneDX",
        "specVersion": "1.5",
        "version": 1,
        "metadata": {"component": product},
        "components": libraries,
        "dependencies": [
            {"ref": "sdre-drive", "dependsOn": [entry["bom-ref"] for entry in libraries]}
        ],
    }


def notices(found):
    parts = [
        "Code of others that sdre-gains and sdre-sil contain or load. The firmware contains none.\n"
    ]
    for component, version, text in found:
        head = f"{component['name']} {version} ({component['license']})"
        parts.append(f"{LINE}\n{head}\n{LINE}\n\n{text.strip()}\n")
    return "\n".join(parts)


def collect(anywhere):
    found = []
    for component in components():
        try:
            version = package_version(component["package"])
            found.append((component, version, notice(component["package"])))
        except MissingError:
            if not anywhere:
                raise
    return found


def main():
    parser = argparse.ArgumentParser(description="components of the host tools, and their notices")
    parser.add_argument("directory", type=Path)
    parser.add_argument("--anywhere", action="store_true")
    options = parser.parse_args()
    try:
        found = collect(options.anywhere)
        document = bill(found)
    except MissingError as error:
        print(f"sbom: {error}", file=sys.stderr)
        return 1
    options.directory.mkdir(parents=True, exist_ok=True)
    file = options.directory / "sdre-drive.cdx.json"
    file.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")
    (options.directory / "THIRD_PARTY.txt").write_text(notices(found), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
