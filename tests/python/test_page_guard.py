# SPDX-License-Identifier: MIT
"""Access to the page: token, Host and Origin, actions, and what its files may load."""

from __future__ import annotations

import http.client
import urllib.parse
from pathlib import Path
from typing import Dict, Iterator, Tuple

import pytest
from conftest import ROOT, Served
from page_support import page_of

STATIC = ROOT / "host_tools/python/sdre_drive/page/static"


@pytest.fixture
def address(served: Served) -> Iterator[str]:
    """Address of a page for the virtual drive, with its token."""
    with page_of(served) as (where, _page):
        yield where


def asked(
    address: str, path: str, headers: Dict[str, str], method: str = "GET", body: bytes = b""
) -> Tuple[int, Dict[str, str]]:
    """Status and headers."""
    at = urllib.parse.urlsplit(address)
    line = http.client.HTTPConnection("127.0.0.1", at.port, timeout=20)
    line.putrequest(method, path, skip_host=True)
    for name, value in {"Host": at.netloc, "Content-Length": str(len(body)), **headers}.items():
        line.putheader(name, value)
    line.endheaders(body)
    answer = line.getresponse()
    answer.read()
    line.close()
    return answer.status, dict(answer.headers.items())


def test_only_who_has_the_token_from_this_page(address: str) -> None:
    at = urllib.parse.urlsplit(address)
    token = urllib.parse.parse_qs(at.query)["token"][0]
    own = f"http://{at.netloc}"
    for path in ("/", "/main.js", "/api/facts", "/api/history"):
        good = f"{path}?token={token}"
        assert asked(address, good, {})[0] == 200
        assert asked(address, good, {"Origin": own})[0] == 200
        assert asked(address, path, {"Cookie": f"sdre_drive_{at.port}={token}"})[0] == 200
        assert asked(address, path, {})[0] == 403
        assert asked(address, f"{path}?token=x", {})[0] == 403
        assert asked(address, path, {"Cookie": f"sdre_drive_{at.port}=x"})[0] == 403
        assert asked(address, path, {"Cookie": f"sdre_drive_{at.port + 1}={token}"})[0] == 403
        assert asked(address, good, {"Origin": "http://example.org"})[0] == 403
        assert asked(address, good, {"Origin": "null"})[0] == 403
        assert asked(address, good, {"Sec-Fetch-Site": "cross-site"})[0] == 403
        assert asked(address, good, {"Host": "example.org"})[0] == 403  # a name bound to 127.0.0.1
        assert asked(address, good, {"Host": f"example.org:{at.port}"})[0] == 403
    assert asked(address, "/api/stream?viewer=12345678", {})[0] == 403


def test_an_action_is_json_from_this_page_and_short(address: str) -> None:
    at = urllib.parse.urlsplit(address)
    token = urllib.parse.parse_qs(at.query)["token"][0]
    path = f"/api/stop?viewer=12345678&token={token}"
    good = {"Origin": f"http://{at.netloc}", "Content-Type": "application/json"}
    assert asked(address, path, good, "POST", b"{}")[0] == 200
    without = {k: v for k, v in good.items() if k != "Origin"}
    assert asked(address, path, without, "POST", b"{}")[0] == 403
    assert asked(address, path, {**good, "Origin": "http://a"}, "POST", b"{}")[0] == 403
    assert asked(address, "/api/stop?viewer=12345678", good, "POST", b"{}")[0] == 403
    form = {**good, "Content-Type": "text/plain"}
    assert asked(address, path, form, "POST", b"{}")[0] == 400
    assert asked(address, path, good, "POST", b"[]")[0] == 400
    assert asked(address, path, good, "POST", b"{")[0] == 400
    assert asked(address, path, {**good, "Content-Length": "999999"}, "POST", b"{}")[0] == 400
    assert asked(address, "/api/nothing?token=" + token, good, "POST", b"{}")[0] == 409


def test_nothing_but_its_own_files(address: str) -> None:
    at = urllib.parse.urlsplit(address)
    token = at.query
    for path in ("/../server.py", "/%2e%2e/server.py", "/static/main.js", "/api/record/x"):
        assert asked(address, f"{path}?{token}", {})[0] == 404
    _, headers = asked(address, f"/?{token}", {})
    policy = headers["Content-Security-Policy"]
    assert policy.startswith("default-src 'none'; script-src 'self'; style-src 'self';")
    assert "unsafe" not in policy and "http" not in policy and "frame-ancestors 'none'" in policy
    assert headers["Referrer-Policy"] == "no-referrer"
    cookie = headers["Set-Cookie"]
    assert "HttpOnly" in cookie and "SameSite=Strict" in cookie


@pytest.mark.parametrize(
    "file", sorted(filter(Path.is_file, STATIC.rglob("*"))), ids=lambda f: f.name
)
def test_files_load_nothing_from_elsewhere_and_parse_no_text(file: Path) -> None:
    text = file.read_text(encoding="utf-8").replace('xmlns="http://www.w3.org/2000/svg"', "")
    for word in (
        "http:",
        "https:",
        "innerHTML",
        "insertAdjacentHTML",
        "eval(",
        "style=",
        "onclick=",
    ):
        assert word not in text, word
    assert len(text.splitlines()) < 300
