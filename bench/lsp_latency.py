#!/usr/bin/env python3
"""Measures what somebody who types waits for: the times of `sdlc lsp`, as a client sees them.

    bench/lsp_latency.py build/release/bin/sdlc [--lines 5000] [--rounds 200]

A scene of LINES lines with three imports is open. In each round one character of it changes; then completion, hover
and the diagnostics of the new text are awaited. Prints medians and 95th percentiles in milliseconds, the time from
the start of the program to the first diagnostics, and the resident memory of the server. Run it on an idle machine.
"""

import argparse
import json
import os
import pathlib
import queue
import statistics
import subprocess
import tempfile
import threading
import time


class Client:
    def __init__(self, program):
        self.process = subprocess.Popen([program, "lsp"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.messages = queue.Queue()
        self.last_id = 0
        threading.Thread(target=self.read, daemon=True).start()

    def read(self):
        stream = self.process.stdout
        while True:
            size = 0
            while (line := stream.readline()) not in (b"\r\n", b""):
                if line.startswith(b"Content-Length:"):
                    size = int(line.split(b":")[1])
            if not line:
                return
            content = stream.read(size)
            # What this client takes to read JSON is not the server's time.
            when = time.perf_counter()
            self.messages.put((when, json.loads(content)))

    def send(self, message):
        content = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n%s" % (len(content), content))
        self.process.stdin.flush()

    def notify(self, method, params):
        self.send({"method": method, "params": params})

    def wait(self, fits):
        while True:
            when, message = self.messages.get(timeout=60)
            if fits(message):
                return when, message

    def ask(self, method, params):
        self.last_id += 1
        self.send({"id": self.last_id, "method": method, "params": params})
        return self.wait(lambda m: m.get("id") == self.last_id and "method" not in m)

    def resident_mib(self):
        status = pathlib.Path(f"/proc/{self.process.pid}/status").read_text()
        return next(int(row.split()[1]) for row in status.splitlines() if row.startswith("VmRSS")) / 1024


def library(imports, n):
    rows = ["scene 1"] + imports
    for i in range(n):
        rows += [f"/// Number {i}.", f"let value{i} = {i} * 0.5 + 1", f"fn curve{i}(x) = value{i} * sin(x * 1deg) ^ 2",
                 f"def pair{i}(gap = 1) {{ sphere {{ center: (gap, 0, 0), radius: 0.1 }} }}"]
    return "\n".join(rows) + "\n"


def scene(lines):
    rows = ["scene 1", 'import "shapes.scene" as shapes', 'import "paints.scene" as paints', 'import "base.scene" as base',
            "camera main { from: (0, 40, 300), at: (0, 0, 0), fov: 40deg }", "background { color: white }",
            "let typed = 0", "let used = typed + base.value1"]
    i = 0
    while len(rows) < lines - 9:
        x, z = i % 50 * 4, i // 50 * 4
        rows += [f"// Row {i}", f"let size{i} = 0.25 + shapes.value{i % 124} / 400",
                 "group { material: diffuse(color: rgb(200, 100, 50))"]
        rows += [f"  sphere {{ center: ({x}, {k * 3}, {z}), radius: size{i} }}" for k in range(5)]
        rows += [f"  shapes.pair{i % 124} {{ gap: 2, translate: ({x}, 0, {z}) }}", "}"]
        i += 1
    return "\n".join(rows) + "\n"


def percentiles(times):
    ordered = sorted(times)
    return f"median {statistics.median(ordered):6.1f} ms   p95 {ordered[int(0.95 * len(ordered))]:6.1f} ms"


def position(text, offset):
    before = text[:offset]
    return {"line": before.count("\n"), "character": offset - (before.rfind("\n") + 1)}


class Measurement:
    def __init__(self, program, folder, lines):
        self.program, self.folder = program, folder
        self.uri = (folder / "root.scene").as_uri()
        (folder / "base.scene").write_text(library([], 124))
        (folder / "shapes.scene").write_text(library(['import "base.scene" as base'], 124))
        (folder / "paints.scene").write_text(library(['import "base.scene" as base'], 124))
        self.text = scene(lines)
        (folder / "root.scene").write_text(self.text)
        self.version = 1

    def start(self):
        """The seconds from the start of the program to the first diagnostics."""
        begin = time.perf_counter()
        self.client = Client(self.program)
        self.client.ask("initialize", {"processId": None, "rootUri": self.folder.as_uri(), "capabilities": {
            "textDocument": {"completion": {
                "completionItem": {"snippetSupport": True, "insertReplaceSupport": True},
                "completionList": {"itemDefaults": ["editRange"]}}}}})
        self.client.notify("initialized", {})
        self.client.notify("textDocument/didOpen", {"textDocument": {
            "uri": self.uri, "languageId": "scene", "version": 1, "text": self.text}})
        when, _ = self.client.wait(self.is_published)
        return (when - begin) * 1e3

    def is_published(self, message):
        return message.get("method") == "textDocument/publishDiagnostics" and message["params"]["uri"] == self.uri

    def replace(self, begin, end, text):
        """Changes the text as an editor does; returns the time of the key."""
        edit = {"range": {"start": position(self.text, begin), "end": position(self.text, end)}, "text": text}
        self.text = self.text[:begin] + text + self.text[end:]
        self.version += 1
        now = time.perf_counter()
        self.client.notify("textDocument/didChange", {
            "textDocument": {"uri": self.uri, "version": self.version}, "contentChanges": [edit]})
        return now

    def at(self, offset):
        return {"textDocument": {"uri": self.uri}, "position": position(self.text, offset)}

    def diagnostics(self, rounds):
        """Each key adds or removes an error, so that new diagnostics are sent."""
        times = []
        at = self.text.index("typed + base") + len("typed")
        for i in range(rounds):
            key = self.replace(at, at + i % 2, "" if i % 2 else "x")
            when, _ = self.client.wait(self.is_published)
            times.append((when - key) * 1e3)
            time.sleep(0.02)
        return times

    def completion(self, rounds, statement):
        """`statement` is typed key by key in the middle of the scene, and completed after each."""
        times = []
        at = self.text.index("// Row 200") if "// Row 200" in self.text else self.text.index("// Row 9")
        for i in range(rounds):
            n = i % len(statement)
            if n == 0 and i > 0:
                self.replace(at, at + len(statement), "")
                time.sleep(0.1)
            key = self.replace(at + n, at + n, statement[n])
            when, _ = self.client.ask("textDocument/completion", self.at(at + n + 1))
            times.append((when - key) * 1e3)
            time.sleep(0.03)
        n = (rounds - 1) % len(statement) + 1
        self.replace(at, at + n, "")
        return times

    def hover(self, rounds):
        times = []
        for i in range(rounds):
            name = f"size{i * 7 % 300}"
            at = self.text.find(f"let {name} ")
            position = self.at(max(at, 0) + 5)
            begin = time.perf_counter()
            when, _ = self.client.ask("textDocument/hover", position)
            times.append((when - begin) * 1e3)
        return times


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("program")
    parser.add_argument("--lines", type=int, default=5000)
    parser.add_argument("--rounds", type=int, default=200)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name).resolve()
        starts = []
        for _ in range(10):
            measurement = Measurement(os.path.abspath(arguments.program), folder, arguments.lines)
            starts.append(measurement.start())
            measurement.client.process.kill()
        measurement = Measurement(os.path.abspath(arguments.program), folder, arguments.lines)
        measurement.start()
        time.sleep(1)
        print(f"{arguments.lines} lines, {arguments.rounds} rounds")
        print(f"start to first diagnostics   {percentiles(starts)}")
        print(f"diagnostics after a key      {percentiles(measurement.diagnostics(arguments.rounds))}")
        whole = "let other = size3 + shapes.value7\n"
        print(f"completion, statement        {percentiles(measurement.completion(arguments.rounds, whole))}")
        half = "sphere { center: (size3, 0, 0), radius: "
        print(f"completion, open brackets    {percentiles(measurement.completion(arguments.rounds, half))}")
        time.sleep(0.5)
        print(f"hover                        {percentiles(measurement.hover(arguments.rounds))}")
        print(f"resident memory              {measurement.client.resident_mib():.0f} MiB")
        measurement.client.process.kill()


if __name__ == "__main__":
    main()
