# SPDX-License-Identifier: MIT
"""Access to the page: only with the token in its address, only from this machine, and from no other
page of the browser."""

from __future__ import annotations

import hmac
from http.cookies import CookieError, SimpleCookie
from typing import Any, Awaitable, Callable, Dict, List
from urllib.parse import parse_qs

Asgi = Callable[
    [Dict[str, Any], Callable[..., Awaitable[Any]], Callable[..., Awaitable[Any]]], Awaitable[None]
]


def cookie_name(port: int) -> str:
    """A browser sends cookies to all ports of a host: each page has its own."""
    return f"sdre_drive_{port}"


def headers_of(scope: Dict[str, Any]) -> Dict[str, str]:
    """The last of each name."""
    return {k.decode("latin-1").lower(): v.decode("latin-1") for k, v in scope.get("headers", [])}


def is_allowed(scope: Dict[str, Any], token: str, port: int) -> bool:
    """Host and Origin are this page's own (another site can neither rebind its name nor post here),
    and the token is right."""
    headers = headers_of(scope)
    hosts = (f"127.0.0.1:{port}", f"localhost:{port}")
    if headers.get("host") not in hosts:
        return False
    if "origin" in headers and headers["origin"] != f"http://{headers['host']}":
        return False
    if scope["type"] == "websocket" and "origin" not in headers:
        return False
    return any(
        hmac.compare_digest(given.encode(), token.encode())
        for given in _tokens(scope, headers, port)
    )


def _tokens(scope: Dict[str, Any], headers: Dict[str, str], port: int) -> List[str]:
    try:
        cookie = SimpleCookie(headers.get("cookie", ""))
    except CookieError:
        cookie = SimpleCookie()
    name = cookie_name(port)
    found = [cookie[name].value] if name in cookie else []
    return found + parse_qs(scope.get("query_string", b"").decode("latin-1")).get("token", [])


class Guard:
    """ASGI middleware over everything, WebSockets included."""

    def __init__(self, app: Asgi, token: str, port: int) -> None:
        self.app, self.token, self.port = app, token, port

    async def __call__(self, scope: Dict[str, Any], receive: Any, send: Any) -> None:
        """Passes on, or answers 403."""
        if scope["type"] == "lifespan":
            await self.app(scope, receive, send)
        elif not is_allowed(scope, self.token, self.port):
            await _refuse(scope, receive, send)
        else:
            await self.app(scope, receive, self._with_cookie(send))

    def _with_cookie(self, send: Any) -> Any:
        """So that what the page loads has the token too."""
        value = f"{cookie_name(self.port)}={self.token}; HttpOnly; SameSite=Strict; Path=/".encode()

        async def out(message: Dict[str, Any]) -> None:
            if message["type"] == "http.response.start":
                message["headers"] = [*message.get("headers", []), (b"set-cookie", value)]
            await send(message)

        return out


async def _refuse(scope: Dict[str, Any], receive: Any, send: Any) -> None:
    if scope["type"] == "websocket":
        await receive()
        await send({"type": "websocket.close", "code": 4403})
        return
    text = b"open the address that sdre-drive printed: it has the token"
    await send(
        {
            "type": "http.response.start",
            "status": 403,
            "headers": [(b"content-type", b"text/plain")],
        }
    )
    await send({"type": "http.response.body", "body": text})
