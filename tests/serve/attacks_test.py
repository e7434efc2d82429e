#!/usr/bin/env python3
"""Tries to misuse `sdlc serve`. usage: attacks_test.py PROGRAM

The server must refuse what does not come from its own page, and must go on serving whatever clients do.
"""

import base64
import contextlib
import os
import pathlib
import resource
import socket
import struct
import subprocess
import sys
import tempfile
import unittest
import urllib.parse

PROGRAM = os.path.abspath(sys.argv[1])
SCENE = """scene 1
camera { from: (0, 0, 9), at: (0, 0, 0), fov: 40deg }
background { color: white }
render { width: 64, samples: 16 }
sphere ball { center: (0, 0, 0), radius: 1, material: diffuse(color: red) }
"""


class Attacks(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        pathlib.Path(folder.name, "a.scene").write_text(SCENE)
        self.program = subprocess.Popen([PROGRAM, "serve", "a.scene"], cwd=folder.name, stdout=subprocess.PIPE,
                                        text=True)
        self.addCleanup(self.end)
        url = urllib.parse.urlsplit(self.program.stdout.readline().strip())
        self.port, self.path, self.host = url.port, url.path, url.netloc
        self.assertRegex(self.path, r"^/[0-9a-f]{32}/$")

    def end(self):
        self.program.terminate()
        self.assertEqual(self.program.wait(), 130)
        self.program.stdout.close()

    def connect(self):
        connection = socket.create_connection(("127.0.0.1", self.port))
        self.addCleanup(connection.close)
        return connection

    @staticmethod
    def answer_on(connection):
        """All that the server sends before it closes."""
        answer = b""
        with contextlib.suppress(ConnectionResetError):
            while part := connection.recv(1 << 16):
                answer += part
        return answer

    def status(self, path=None, method="GET", host=None, headers=()):
        lines = [f"{method} {self.path if path is None else path} HTTP/1.1", f"Host: {host or self.host}", *headers]
        connection = self.connect()
        connection.sendall("\r\n".join([*lines, "", ""]).encode())
        answer = self.answer_on(connection)
        return int(answer.split()[1]) if answer else None

    def handshake(self, path=None, host=None, origin="own"):
        """A connection, and the status of its upgrade to a WebSocket."""
        lines = [f"GET {self.path if path is None else path}live HTTP/1.1", f"Host: {host or self.host}",
                 "Upgrade: websocket", "Connection: Upgrade", "Sec-WebSocket-Version: 13",
                 f"Sec-WebSocket-Key: {base64.b64encode(os.urandom(16)).decode()}"]
        if origin == "own":
            origin = f"http://{host or self.host}"
        if origin is not None:
            lines.append(f"Origin: {origin}")
        connection = self.connect()
        connection.sendall("\r\n".join([*lines, "", ""]).encode())
        answer = b""
        while b"\r\n\r\n" not in answer:
            part = connection.recv(1)
            if not part:
                break
            answer += part
        return connection, int(answer.split()[1])

    @staticmethod
    def frame(payload, opcode=1, length=None):
        """A frame of a client, masked with zeros; `length`: the one that its header claims."""
        size = len(payload) if length is None else length
        head = bytes([0x80 | opcode])
        if size < 126:
            head += bytes([0x80 | size])
        elif size < 1 << 16:
            head += bytes([0x80 | 126]) + struct.pack(">H", size)
        else:
            head += bytes([0x80 | 127]) + struct.pack(">Q", size)
        return head + bytes(4) + payload

    def assert_serves(self):
        self.assertEqual(self.status(), 200)
        connection, status = self.handshake()
        self.assertEqual(status, 101)
        self.assertNotEqual(connection.recv(1), b"", "the scene is sent")

    def test_only_the_token_opens_the_page(self):
        self.assert_serves()
        self.assertEqual(self.status(self.path + "picture.svg"), 404)
        for path in ["/", "//", "/index.html", self.path[:-1], self.path[:-2] + "/", "/" + "0" * 32 + "/",
                     self.path.upper(), "/x" + self.path]:
            self.assertEqual(self.status(path), 404, path)
        self.assertEqual(self.handshake(path="/")[1], 404)
        self.assertEqual(self.handshake(path="/" + "0" * 32 + "/")[1], 404)

    def test_no_path_opens_a_file(self):
        for name in ["a.scene", "../a.scene", "../../../../etc/passwd", "%2e%2e/%2e%2e/etc/passwd", "..%2fa.scene",
                     "/etc/passwd", "picture.png/../a.scene", "a.scene%00.png"]:
            self.assertIn(self.status(self.path + name), (400, 404), name)

    def test_other_names_of_the_host_are_refused(self):
        for host in ["evil.example", f"evil.example:{self.port}", "127.0.0.1.evil.example", "localhost.evil.example",
                     "127.0.0.2", "0.0.0.0", "[::2]", "localhost:x", "127.0.0.1:80:80"]:
            self.assertEqual(self.status(host=host), 421, host)
            self.assertEqual(self.handshake(host=host)[1], 421, host)
        # Ports may be forwarded.
        for host in ["localhost", "127.0.0.1", f"localhost:{self.port + 1}", "[::1]:9"]:
            self.assertEqual(self.status(host=host), 200, host)

    def test_other_origins_are_refused(self):
        for origin in ["http://evil.example", "null", f"https://{self.host}", "http://127.0.0.1:1",
                       f"http://{self.host}.evil.example", "file://"]:
            self.assertEqual(self.handshake(origin=origin)[1], 403, origin)
            self.assertEqual(self.status(headers=[f"Origin: {origin}"]), 403, origin)
        self.assertEqual(self.handshake(origin=None)[1], 403, "all browsers tell it")

    def test_other_methods_are_refused(self):
        for method in ["POST", "PUT", "DELETE", "OPTIONS"]:
            self.assertEqual(self.status(method=method), 405, method)
        self.assertEqual(self.status(headers=["Access-Control-Request-Method: GET"]), 200)

    def test_garbage_and_long_headers_do_no_harm(self):
        for garbage in [b"\x00" * 100, b"GET\r\n\r\n", b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", b"\r\n\r\n" * 9]:
            connection = self.connect()
            connection.sendall(garbage)
            connection.shutdown(socket.SHUT_WR)
            self.assertNotIn(b" 200 ", self.answer_on(connection))
        self.assertIn(self.status(headers=["X: " + "x" * 100_000]), (None, 413))
        self.assertIn(self.status(headers=["Content-Length: 1000000"]), (None, 413))
        self.assert_serves()

    def test_many_connections(self):
        soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
        resource.setrlimit(resource.RLIMIT_NOFILE, (min(hard, 4096), hard))
        self.addCleanup(resource.setrlimit, resource.RLIMIT_NOFILE, (soft, hard))
        for _ in range(5):
            idle = []
            with contextlib.suppress(OSError):
                for _ in range(2000):
                    idle.append(socket.create_connection(("127.0.0.1", self.port), timeout=5))
            for connection in idle:
                connection.close()
        self.assert_serves()

    def test_half_frames_and_wrong_frames(self):
        waiting = []
        for bad in [b"\x81", b"\x81\xfe\x01", self.frame(b'{"type"', length=500), b"\xff\xff\xff\xff",
                    b"\x81\x05hello", self.frame(b"x", opcode=5), self.frame(b"\xff\xfe"), self.frame(b"", opcode=8),
                    self.frame(b"x" * 200, opcode=9)]:
            connection, status = self.handshake()
            self.assertEqual(status, 101)
            connection.sendall(bad)
            waiting.append(connection)
        self.assert_serves()

    def test_a_message_of_100_megabytes(self):
        connection, _ = self.handshake()
        with contextlib.suppress(ConnectionError):
            connection.sendall(self.frame(b"", length=100 << 20))
            for _ in range(100):
                connection.sendall(b"x" * (1 << 20))
            self.fail("the connection should be closed")
        self.assert_serves()
        self.assertLess(self.peak_memory(), 300_000, "KB")

    def test_messages_that_no_page_sends(self):
        connection, _ = self.handshake()
        for text in ["", "{", "[]", "null", '"x"', '{"type":1}', '{"type":"view","channel":7}',
                     '{"type":"view","channel":"none","exposure":"a"}', '{"type":"view","exposure":1e308}',
                     '{"type":"pick","x":-5,"y":99999999999}', '{"type":"pick","x":1e99,"y":{}}',
                     '{"type":"pixel","x":2147483647,"y":-2147483648}', '{"type":"choose","params":{"none":"1"}}',
                     '{"type":"choose","params":[1]}', '{"type":"choose","params":{"a":3}}',
                     '{"type":"choose","frame":1e99}', '{"type":"choose","camera":"none"}',
                     '{"type":"choose","camera":null,"pose":{"from":[0,0,1e999],"at":[0,0,0]}}',
                     '{"type":"choose","pose":{"from":[0,0,0],"at":[0,0,0]}}',
                     '{"type":"choose","pose":{"from":[0,0]}}', '{"type":"choose","pose":null}',
                     '{"type":"open","place":{"path":"/etc/passwd"}}', "[" * 30_000]:
            connection.sendall(self.frame(text.encode()))
        self.assert_serves()

    def test_a_client_that_reads_nothing_is_closed(self):
        connection, _ = self.handshake()
        connection.settimeout(60)
        self.wait_for_picture()
        # More answers than the buffers of a connection hold.
        with self.assertRaises(ConnectionError):
            for _ in range(200):
                connection.sendall(1000 * self.frame(b'{"type":"pixel","x":5,"y":5}'))
                self.assert_serves()
        self.assertLess(self.peak_memory(), 300_000, "KB")

    def wait_for_picture(self):
        for _ in range(10_000):
            if self.status(self.path + "picture.png") == 200:
                return
        self.fail("there is no picture")

    def peak_memory(self):
        status = pathlib.Path(f"/proc/{self.program.pid}/status").read_text()
        return int(status.split("VmHWM:")[1].split()[0])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
