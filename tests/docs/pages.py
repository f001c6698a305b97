"""The project's pages: every README.md, its headings, links, code spans and blocks."""
import re
from pathlib import Path

NOT_OURS = re.compile(r"^(build.*|out|\.git|\.cache)$")


def pages(root):
    """Every README.md of the project, the top one first."""
    found = [path for path in sorted(root.rglob("README.md")) if not any(map(NOT_OURS.match, path.relative_to(root).parts))]
    return sorted(found, key=lambda path: len(path.parts))


class Block:
    """A fenced block: its language, first line of text, text, and the HTML comment right above it."""

    def __init__(self, language, line, comment):
        self.language, self.line, self.comment, self.lines = language, line, comment, []

    @property
    def text(self):
        return "".join(line + "\n" for line in self.lines)

    @property
    def slow(self):
        """What `<!-- slow: 4 min -->` says; None without it."""
        match = re.fullmatch(r"<!-- slow: (.+) -->", self.comment)
        return match and match[1]


class Page:
    def __init__(self, path):
        self.path = path
        self.lines = path.read_text(encoding="utf-8").split("\n")[:-1]
        self.blocks = []
        self.prose = []  # (line number, text) outside of blocks
        self.open = None  # line of a fence that is never closed
        block = None
        for number, line in enumerate(self.lines, 1):
            if line.startswith("```") and block is None:
                above = self.lines[number - 2].strip() if number > 1 else ""
                block = Block(line[3:].strip(), number + 1, above)
                self.open = number
            elif line.startswith("```"):
                self.blocks.append(block)
                block = self.open = None
            elif block is not None:
                block.lines.append(line)
            else:
                self.prose.append((number, line))

    def links(self):
        """(line number, target) of links and images."""
        for number, line in self.prose:
            for match in re.finditer(r"\]\(([^()\s]+)\)", re.sub(r"`[^`]*`", "", line)):
                yield number, match[1]

    def spans(self):
        """(line number, text) of code in backticks; one may run over the end of a line, within a paragraph."""
        paragraph = []
        for number, line in self.prose + [(0, "")]:
            if line.strip():
                paragraph.append((number, line))
                continue
            starts, text = [], ""
            for at, part in paragraph:
                starts.append((len(text), at))
                text += part + "\n"
            for match in re.finditer(r"`([^`]+)`", text):
                yield [at for start, at in starts if start <= match.start()][-1], " ".join(match[1].split())
            paragraph = []

    def anchors(self):
        """What GitHub calls the headings."""
        names = set()
        for _, line in self.prose:
            heading = re.match(r"#+\s+(.*)", line)
            if not heading:
                continue
            text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading[1]).replace("`", "").strip().lower()
            name = re.sub(r"[^\w\- ]", "", text).replace(" ", "-")
            count = sum(known == name or re.fullmatch(re.escape(name) + r"-\d+", known) is not None for known in names)
            names.add(f"{name}-{count}" if count else name)
        return names
