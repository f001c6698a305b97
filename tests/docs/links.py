#!/usr/bin/python3
"""Checks what the project's pages name: links, anchors and pictures, files, options of tools, changes to sources (```diff), and how
long a page is.

links.py [--root DIR] [--bin DIR]      --bin: where the tools are; without it options are not looked at, which is said
"""
import argparse
import re
import subprocess
import sys
from pathlib import Path

from pages import Page, pages

LINES = {"README.md": 180}  # of a page, at most; others:
OTHER_LINES = 450
OPTION = re.compile(r"(?<![\w=-])--[a-z][a-z-]*")  # what stands behind "=" is another program's
COMMAND = re.compile(r"^Subcommands:\n((?:  .*\n)+)", re.MULTILINE | re.IGNORECASE)
SOURCE = re.compile(r"[\w.-]+(/[\w.-]+)+\.(cpp|h|glsl|frag|vert|comp|sh|py|cmake|md|json)")


class Checker:
    def __init__(self, root, binaries):
        self.root, self.binaries = root, binaries
        self.faults = []
        self.helps = {}
        self.known = {}

    def fault(self, page, line, text):
        self.faults.append(f"{page.path.relative_to(self.root)}:{line}: {text}")

    def page(self, path):
        if path not in self.known:
            self.known[path] = Page(path)
        return self.known[path]

    def check(self):
        for path in pages(self.root):
            page = self.page(path)
            self.check_length(page)
            for line, target in page.links():
                self.check_link(page, line, target)
            for line, text in page.spans():
                self.check_file(page, line, text)
                self.check_options(page, line, text, alone=True)
            for block in page.blocks:
                if block.language == "diff":
                    self.check_changes(page, block)
                if block.language in ("sh", "bash"):
                    for line, command in commands(block):
                        self.check_options(page, line, command, alone=False)
            self.check_listed(page)
        return self.faults

    def check_length(self, page):
        most = LINES.get(str(page.path.relative_to(self.root)), OTHER_LINES)
        if len(page.lines) > most:
            self.fault(page, len(page.lines), f"{len(page.lines)} lines, of at most {most}")
        if page.open:
            self.fault(page, page.open, "a block that is never closed")

    def check_link(self, page, line, target):
        if re.match(r"https://", target):
            return
        path, _, anchor = target.partition("#")
        to = (page.path.parent / path).resolve() if path else page.path
        if not to.exists():
            return self.fault(page, line, f"link to {target}: there is no such file")
        if self.root not in (to, *to.parents):
            return self.fault(page, line, f"link to {target}: leads out of the project")
        if to.is_file() and to.stat().st_size == 0:
            self.fault(page, line, f"link to {target}: the file is empty")
        if anchor and (to.suffix != ".md" or anchor not in self.page(to).anchors()):
            self.fault(page, line, f"link to {target}: there is no such heading")

    def check_file(self, page, line, text):
        """A source that is named by its path: from the page's folder, one below it, or the project's."""
        if not SOURCE.fullmatch(text) or text.split("/")[0] in ("build", "out"):
            return
        if (self.root / text).exists() or any(page.path.parent.rglob(text)):
            return
        self.fault(page, line, f"`{text}`: there is no such file")

    def help_of(self, tool):
        if tool not in self.helps:
            program = self.binaries / tool
            self.helps[tool] = None
            if program.exists():
                self.helps[tool] = set(OPTION.findall(help_text([program])))
        return self.helps[tool]

    def all_options(self):
        if "" not in self.helps:
            tools = [program.name for program in self.binaries.glob("tyndall-*")]
            scripts = [path for folder in ("samples", "tests") for path in (self.root / folder).rglob("*.[sp][hy]")]
            self.helps[""] = set().union(*map(self.help_of, tools))
            self.helps[""] |= {option for path in scripts for option in OPTION.findall(path.read_text(encoding="utf-8"))}
        return self.helps[""]

    def check_options(self, page, line, text, alone):
        """Of a command: those of the tool or script that it names. In prose an option may stand by itself: it is one of any."""
        text = text.partition(" -- ")[0]
        words = text.split()
        tools = [word for word in words if re.fullmatch(r"(build/bin/)?tyndall-[\w-]+", word)]
        scripts = [word for word in words if re.fullmatch(r"[\w.-]+(/[\w.-]+)+\.(sh|py)", word)]
        if scripts:
            script = next((path for path in (self.root / scripts[0], page.path.parent / scripts[0]) if path.exists()), None)
            if not script:
                return self.fault(page, line, f"{scripts[0]}: there is no such script")
            return self.missing(page, line, text, scripts[0], set(OPTION.findall(script.read_text(encoding="utf-8"))))
        if not self.binaries or not (tools or (alone and text.startswith("--"))):
            return None
        if not tools:
            return self.missing(page, line, text, "any tool or script", self.all_options())
        tool = tools[0].rsplit("/", maxsplit=1)[-1]
        if self.help_of(tool) is None:
            if "/" in tools[0] or OPTION.search(text) or alone and len(words) == 1:
                self.fault(page, line, f"{tool}: there is no such tool in {self.binaries}")
            return None
        return self.missing(page, line, text, tool, self.helps[tool])

    def missing(self, page, line, text, tool, options):
        for option in OPTION.findall(text):
            if option not in options:
                self.fault(page, line, f"{option}: not an option of {tool}")

    def check_changes(self, page, block):
        """What a change takes away or leaves must stand in its file, in this order and without gaps, once."""
        source, hunk = None, []
        for line in block.lines + ["@@"]:
            if line.startswith(("--- ", "@@")):
                if hunk:
                    self.check_hunk(page, block.line, source, hunk)
                hunk = []
                if line.startswith("--- "):
                    source = line.removeprefix("--- a/")
            elif not line.startswith("+"):
                hunk.append(line[1:])

    def check_hunk(self, page, line, source, hunk):
        path = self.root / source if source else None
        if not path or not path.exists():
            return self.fault(page, line, f"change of {source}: there is no such file")
        times = ("\n" + path.read_text(encoding="utf-8")).count("\n" + "\n".join(hunk) + "\n")
        if times != 1:
            self.fault(page, line, f"change of {source}: its lines stand there {times} times:\n    " + "\n    ".join(hunk))
        return None

    def check_listed(self, page):
        """<!-- names every file of: FOLDER... that has: WORD|WORD -->."""
        for number, line in page.prose:
            asked = re.fullmatch(r"<!-- names every file of: (.+) that has: (.+) -->", line.strip())
            if not asked:
                continue
            text = "\n".join(page.lines[number:])
            for folder in asked[1].split():
                for path in sorted((self.root / folder).rglob("*.*")):
                    name = str(path.relative_to(self.root))
                    if path.suffix != ".md" and re.search(asked[2], path.read_text(encoding="utf-8")) and f"`{name}`" not in text:
                        self.fault(page, number, f"{name} is not named")


def help_text(command):
    """What --help says, of subcommands, too."""
    answer = subprocess.run(command + ["--help"], capture_output=True, text=True, check=False)
    text = answer.stdout + answer.stderr
    for listed in COMMAND.findall(text):
        for line in listed.splitlines():
            text += help_text(command + line.split()[:1])
    return text


def commands(block):
    """(line number, command) with continued lines joined, comments left out."""
    whole, first = "", block.line
    for number, line in enumerate(block.lines, block.line):
        if not whole:
            first = number
        whole += line.split(" # ")[0]
        if whole.endswith("\\"):
            whole = whole[:-1] + " "
            continue
        if not whole.lstrip().startswith("#"):
            for command in re.split(r"\s*(?:\||;|&&)\s*", whole):
                yield first, command
        whole = ""


def main():
    parser = argparse.ArgumentParser(description="Checks what the project's pages name.")
    parser.add_argument("--root", type=Path, default=Path(__file__).resolve().parents[2])
    parser.add_argument("--bin", type=Path)
    given = parser.parse_args()
    faults = Checker(given.root.resolve(), given.bin and given.bin.resolve()).check()
    for fault in faults:
        print(fault)
    if not given.bin:
        print("skipped: options of the tools (no --bin)")
    print(f"{len(pages(given.root))} pages, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
