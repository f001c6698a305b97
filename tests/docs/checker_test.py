#!/usr/bin/python3
"""The checkers of pages themselves: each fault is found, named by page and line, and nothing else is."""
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent


class Project(unittest.TestCase):
    """A project of its own with a page and a tool."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = Path(self.folder.name) / "project"
        self.write("effect/src/Passes.h", "enum {\n  Refine,\n  Offsets,\n};\n")
        self.write("tests/run.sh", "case $1 in --all) ;; esac\n")
        self.write("samples/picture.png", "not empty")
        self.write("build/bin/tyndall-render", "#!/bin/sh\necho '--help, --out IMAGE, --size WxH'\n")
        os.chmod(self.root / "build/bin/tyndall-render", 0o755)

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def run_checker(self, script, *options):
        done = subprocess.run([sys.executable, HERE / script, "--root", self.root, *options], capture_output=True,
                              text=True, check=False)
        self.assertNotIn("Traceback", done.stderr)
        return done.returncode, done.stdout


class Links(Project):
    def faults_of(self, text):
        self.write("README.md", text)
        status, output = self.run_checker("links.py", "--bin", self.root / "build/bin")
        faults = output.splitlines()[:-1]
        self.assertEqual(status, 1 if faults else 0)
        return faults

    def test_a_page_without_fault_has_none(self):
        self.write("effect/README.md", "# The library\n\n## TAA, `exact` & more\n")
        self.assertEqual(self.faults_of(
            "# Title\n\n![a](samples/picture.png) [b](effect/README.md#taa-exact--more) [c](#title) [d](effect)\n"
            "[e](https://example.org/x)\n`tyndall-render x.glb --out y.png` `--size` `sh tests/run.sh --all` `effect/src/Passes.h`\n"
            "`[no](link)`\n\n```sh\n[ -e x ] || build/bin/tyndall-render \\\n  --size 1x1 # --not an option\n```\n\n"
            "```diff\n--- a/effect/src/Passes.h\n@@\n   Refine,\n+  Widen,\n   Offsets,\n```\n"), [])

    def test_a_broken_link_is_found(self):
        self.assertEqual(self.faults_of("# Title\n[a](effect/missing.md)\n"),
                         ["README.md:2: link to effect/missing.md: there is no such file"])

    def test_a_missing_picture_is_found(self):
        self.assertEqual(self.faults_of("![a](samples/missing.png)\n"),
                         ["README.md:1: link to samples/missing.png: there is no such file"])

    def test_a_broken_anchor_is_found_here_and_there(self):
        self.write("effect/README.md", "# The library\n")
        self.assertEqual(self.faults_of("# Title\n[a](#titel)\n[b](effect/README.md#library)\n"),
                         ["README.md:2: link to #titel: there is no such heading",
                          "README.md:3: link to effect/README.md#library: there is no such heading"])

    def test_an_unknown_option_is_found_in_prose_and_in_commands(self):
        self.assertEqual(self.faults_of("`tyndall-render --siez 1x1` and `--sizes`\n\n```sh\nbuild/bin/tyndall-render \\\n  --uot x\n```\n"),
                         ["README.md:1: --siez: not an option of tyndall-render",
                          "README.md:1: --sizes: not an option of any tool or script",
                          "README.md:4: --uot: not an option of tyndall-render"])

    def test_an_unknown_tool_script_or_file_is_found(self):
        self.assertEqual(self.faults_of("`tyndall-rendr` `sh tests/rum.sh` `sh tests/run.sh --al` `effect/src/Pass.h`\n"),
                         ["README.md:1: tyndall-rendr: there is no such tool in " + str(self.root / "build/bin"),
                          "README.md:1: tests/rum.sh: there is no such script",
                          "README.md:1: --al: not an option of tests/run.sh",
                          "README.md:1: `effect/src/Pass.h`: there is no such file"])

    def test_a_change_that_does_not_fit_its_file_is_found(self):
        fault, *lines = self.faults_of("```diff\n--- a/effect/src/Passes.h\n@@\n   Refine,\n-  Marks,\n   Offsets,\n```\n")
        self.assertEqual(fault, "README.md:2: change of effect/src/Passes.h: its lines stand there 0 times:")
        self.assertEqual(lines, ["      Refine,", "      Marks,", "      Offsets,"])

    def test_a_page_that_grows_too_long_is_found(self):
        self.assertEqual(self.faults_of("x\n" * 180), [])
        self.assertEqual(self.faults_of("x\n" * 181), ["README.md:181: 181 lines, of at most 180"])

    def test_a_file_that_a_list_leaves_out_is_found(self):
        listed = "<!-- names every file of: effect/src that has: Refine -->\n"
        self.assertEqual(self.faults_of(listed), ["README.md:1: effect/src/Passes.h is not named"])
        self.assertEqual(self.faults_of(listed + "`effect/src/Passes.h`\n"), [])


class Commands(Project):
    def test_blocks_run_from_top_to_bottom_in_a_copy(self):
        self.write("README.md", "```sh\necho one > file\ntest -x build/bin/tyndall-render\n```\n\n```bash\n[[ $(cat file) == one ]]\n```\n\n```cpp\nnot run\n```\n")
        status, output = self.run_checker("commands.py", "--build", self.root / "build")
        self.assertEqual(status, 0, output)
        self.assertIn("1 pages, 0 blocks failed, 0 left out", output)
        self.assertFalse((self.root / "file").exists())

    def test_a_broken_command_is_found_and_the_next_block_runs(self):
        self.write("README.md", "# Title\n\n```sh\necho said; false\necho not reached\n```\n\n```bash\nfalse | true\n```\n\n```sh\ntrue\n```\n")
        status, output = self.run_checker("commands.py")
        self.assertEqual(status, 1)
        self.assertIn("FAILED README.md:4 ", output)
        self.assertIn("  | said\n", output)
        self.assertNotIn("| not reached", output)
        self.assertIn("FAILED README.md:9 ", output)
        self.assertIn("ok     README.md:13 ", output)
        self.assertIn("2 blocks failed", output)

    def test_a_slow_block_is_left_out_and_named_but_run_when_asked_for(self):
        self.write("README.md", "<!-- slow: 40 min -->\n```sh\nfalse\n```\n")
        status, output = self.run_checker("commands.py")
        self.assertEqual(status, 0)
        self.assertIn("left out: README.md:3 (40 min)\n", output)
        self.assertEqual(self.run_checker("commands.py", "--slow")[0], 1)


if __name__ == "__main__":
    unittest.main()
