# SPDX-License-Identifier: MIT
"""Access to the page: only with the token in its address, only from this machine, and from no other
page of the browser."""

from __future__ import annotations

import hmac
from http.cookies import CookieError, SimpleCookie
from typing import Dict, List, Mapping
from urllib.parse import parse_qs, urlsplit

REFUSED = "open the address that sdre-drive printed: it has the token"

# The page is its own scripts, styles and pictures. Nothing is loaded from elsewhere, nothing is
# evaluated, and no other page has it in a frame.
HEADERS = {
    "Content-Security-Policy": (
        "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; "
        "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
    ),
    "Cache-Control": "no-store",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}


def cookie_name(port: int) -> str:
    """A browser sends cookies to all ports of a host: each page has its own."""
    return f"sdre_drive_{port}"


def cookie(token: str, port: int) -> str:
    """So that what the page loads has the token too."""
    return f"{cookie_name(port)}={token}; HttpOnly; SameSite=Strict; Path=/"


def is_allowed(method: str, path: str, headers: Mapping[str, str], token: str, port: int) -> bool:
    """Host and Origin are this page's own (another site can neither rebind its name nor post here),
    and the token is right. A browser names the origin of every POST, so one without is refused.
    Names of headers are in lower case."""
    if headers.get("host") not in (f"127.0.0.1:{port}", f"localhost:{port}"):
        return False
    if headers.get("origin", f"http://{headers['host']}") != f"http://{headers['host']}":
        return False
    if method == "POST" and "origin" not in headers:
        return False
    if headers.get("sec-fetch-site", "none") not in ("none", "same-origin"):
        return False
    return any(
        hmac.compare_digest(given.encode(), token.encode())
        for given in _tokens(path, headers, port)
    )


def _tokens(path: str, headers: Mapping[str, str], port: int) -> List[str]:
    try:
        jar = SimpleCookie(headers.get("cookie", ""))
    except CookieError:
        jar = SimpleCookie()
    name = cookie_name(port)
    found = [jar[name].value] if name in jar else []
    return found + parse_qs(urlsplit(path).query).get("token", [])


def lower(headers: Mapping[str, str]) -> Dict[str, str]:
    """The last of each name, in lower case."""
    return {name.lower(): value for name, value in headers.items()}
