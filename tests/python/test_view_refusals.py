"""Whom the viewer's server turns away, what doesn't go with it, and what it says then."""

import contextlib
import socket

import pytest

from live_page import LONG, Closed, Page, Refused, Served
from program import complaint


def test_the_four_refusals(run):
    assert run.get("/", {"Host": "evil.example"})[0] == 421
    with pytest.raises(Refused, match="403"):
        Page(run, origin="http://evil.example")
    with run.page(token="wrong") as page:
        reply = page.ask("pause")
        assert page.ask("hello") == {**reply, "id": 2}, "it is told of its token before it asks for anything"
    assert not reply["ok"] and "token" in reply["error"] and reply["token"] is False
    with run.page() as page:
        page.do("hello")
    assert "--token" in complaint("run", "walk_flat", "--view", "--listen", "0.0.0.0")


def test_without_a_token_a_page_may_look(run):
    with run.page(token="") as page:
        assert page.status()["clients"] >= 1
        while not page.blocks:
            page.hear()


def test_a_port_in_use_is_told_with_what_to_do(run):
    text = complaint("run", "walk_flat", "--view", "--port", run.port)
    assert f"port {run.port}" in text and "--port" in text


def test_what_does_not_go_with_a_view_is_told():
    assert "--seeds" in complaint("run", "walk_flat", "--view", "--seeds", 3)
    assert "--record" in complaint("run", "walk_flat", "--view", "--report", "out")
    assert "--view" in complaint("run", "walk_flat", "--listen", "0.0.0.0")
    assert "--no-wait belong to --view" in complaint("run", "walk_flat", "--no-wait")
    assert "16 to 128" in complaint("run", "walk_flat", "--view", "--token", "short")
    assert "65535" in complaint("run", "walk_flat", "--view", "--port", 70000)
    assert "64" in complaint("run", "walk_flat", "--view", "--view-clients", 65)


def test_a_page_too_many_is_told_the_limit():
    with Served("run", "walk_flat", "--view", "--view-clients", 2, *LONG) as run, run.page() as first, run.page() as second:
        with pytest.raises(Closed, match="2 pages watch already, the limit; close one of them, or raise --view-clients"), run.page() as third:
            third.hear()
        assert first.status(lambda status: status["clients"] == 2) and second.status()


def test_what_a_page_cannot_do_is_refused(log):
    for words, part in [
        (["run", "walk_flat", "--view", "--video", "x.mp4"], "--view shows one run, and can't go with --video"),
        (["demo", "--view", "--out", "x"], "can't go with --out"),
        (["demo", "--view", "--seeds", 3], "can't go with --seeds"),
        (["demo", "--view", "--jobs", 1], "can't go with --jobs"),
        (["replay", log, "--verify", "--port", 8123], "--verify and --stack don't serve"),
        (["replay", log, "--stack", "walk", "--listen", "127.0.0.1"], "--verify and --stack don't serve"),
    ]:
        assert part in complaint(*words)


def test_too_many_connections_are_told_so():
    with Served("run", "walk_flat", "--view", "--view-clients", 1, *LONG) as served, contextlib.ExitStack() as open_ones:
        sockets = [open_ones.enter_context(socket.create_connection((served.host, served.port), timeout=20)) for _ in range(45)]
        assert sockets[-1].recv(1000).startswith(b"HTTP/1.1 503 ")
        sockets[0].sendall(f"GET /api/session HTTP/1.1\r\nHost: {served.host}:{served.port}\r\n\r\n".encode())
        assert sockets[0].recv(1000).startswith(b"HTTP/1.1 200 ")
