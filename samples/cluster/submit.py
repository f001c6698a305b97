#!/usr/bin/env python3
"""Renders an animation, or a list of regression cases, as an array job of a Slurm cluster.

  submit.py film SCENE --frames A-B --tasks N --out DIR [-- OPTIONS OF tyndall-render]
  submit.py regress LIST --references DIR --tasks N --out DIR [-- OPTIONS OF tyndall-regress check]

Each task renders its share; a last job makes the film or the report. Submitted again, only what is missing is rendered.
"""
import argparse
import hashlib
import json
import os
import re
import shlex
import shutil
import stat
import subprocess
import sys
from pathlib import Path
from urllib.parse import unquote

HERE = Path(__file__).resolve().parent
MANIFEST = "tyndall.json"
MAX_FRAME = 999999


class Refusal(Exception):
    """One line that names what is wrong, and the exit status."""

    def __init__(self, line, status=1):
        super().__init__(line)
        self.status = status


def usage(line):
    return Refusal(line, 2)


# ----------------------------------------------------------------------------------------------------------------------
# The command line


class Parser(argparse.ArgumentParser):
    def error(self, message):
        raise usage(f"{message}; --help lists the options")


def frame_range(text):
    parts = re.fullmatch(r"(\d{1,6})-(\d{1,6})", text)
    if not parts or int(parts[1]) > int(parts[2]):
        raise argparse.ArgumentTypeError(f"{text}: must be FIRST-LAST, 0 <= FIRST <= LAST <= {MAX_FRAME}")
    return range(int(parts[1]), int(parts[2]) + 1)


def task_count(text):
    if not re.fullmatch(r"[1-9]\d{0,5}", text):
        raise argparse.ArgumentTypeError(f"{text}: must be a whole number from 1 on")
    return int(text)


def film_name(text):
    if not re.fullmatch(r"[^/%.][^/%]*\.(mp4|webm)", text):
        raise argparse.ArgumentTypeError(f"{text}: must be a file's name that ends in .mp4 or .webm")
    return text


def parse(arguments):
    parser = Parser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter, allow_abbrev=False)
    shared = argparse.ArgumentParser(add_help=False, allow_abbrev=False)
    shared.add_argument("--tasks", metavar="N", type=task_count, required=True, help="tasks of the array")
    shared.add_argument("--out", metavar="DIR", type=Path, required=True, help="the folder of all that is written")
    shared.add_argument("--bin", metavar="DIR", type=Path, help="the folder of Tyndall's tools (default: the build's)")
    shared.add_argument("--sbatch", metavar="OPTION", action="append", default=[],
                        help="for both jobs, as --sbatch=--time=2:00:00; may be given again")
    shared.add_argument("--dry-run", action="store_true", help="print what would be submitted, and write nothing")
    kinds = parser.add_subparsers(dest="kind", metavar="film|regress", required=True, parser_class=Parser)
    film = kinds.add_parser("film", parents=[shared], allow_abbrev=False, help="an animation's frames, and its film")
    film.add_argument("scene", metavar="SCENE", type=Path)
    film.add_argument("--frames", metavar="A-B", type=frame_range, required=True)
    film.add_argument("--exr", action="store_true", help="frames as EXR, too")
    film.add_argument("--film", metavar="NAME", type=film_name, default="film.mp4",
                      help="its name in DIR, .mp4 or .webm (default film.mp4)")
    regress = kinds.add_parser("regress", parents=[shared], allow_abbrev=False, help="regression cases, and a report")
    regress.add_argument("list", metavar="LIST", type=Path)
    regress.add_argument("--references", metavar="DIR", type=Path, required=True)
    regress.add_argument("--scenes", metavar="DIR", type=Path, help="where the list's names of scenes start")

    split = arguments.index("--") if "--" in arguments else len(arguments)
    options = parser.parse_args(arguments[:split])
    options.passed = arguments[split + 1:]
    if "%" in str(options.out.absolute()):
        raise usage(f"--out {options.out}: must not hold %, which stands for numbers in names")
    return options


# ----------------------------------------------------------------------------------------------------------------------
# What a folder's pictures depend on


def digest(file):
    return hashlib.sha256(read(file)).hexdigest()


def read(file):
    try:
        return Path(file).read_bytes()
    except OSError as error:
        raise Refusal(f"{file}: cannot be read: {error.strerror}") from None


def tool(name, folder):
    built = folder or HERE.parent.parent / "build" / "bin"
    found = built / name if (built / name).is_file() or folder else shutil.which(name)
    if not found or not os.access(found, os.X_OK):
        raise Refusal(f"{found or name}: cannot be run: build it, or name its folder by --bin")
    return str(Path(found).absolute())


def files_of(scene):
    """The scene's file and those that it refers to."""
    data = read(scene)
    if data[:4] == b"glTF":
        data = data[20:20 + int.from_bytes(data[12:16], "little")]
    try:
        parts = json.loads(data)
        uris = [part["uri"] for kind in ("buffers", "images") for part in parts.get(kind, []) if "uri" in part]
    except (ValueError, AttributeError, TypeError, KeyError):
        return [scene]  # tyndall-render says what is wrong with it
    return [scene] + [scene.parent / unquote(str(uri)) for uri in uris if not str(uri).startswith("data:")]


def value_of(option, words):
    for word, following in zip(words, words[1:] + [None]):
        if word == option:
            return following
        if word.startswith(option + "="):
            return word[len(option) + 1:]
    return None


def refuse_options(words, program, *ours):
    for word in words:
        if word.split("=")[0] in ours:
            raise usage(f"{word}: is set by submit.py, and cannot be passed to {program}")


def film_identity(options, renderer):
    medium = value_of("--medium", options.passed)
    files = files_of(options.scene) + ([Path(medium)] if medium else [])
    return {"kind": "film", "first frame": options.frames[0], "pictures": ["png", "exr"] if options.exr else ["png"],
            "options": options.passed, "tyndall-render": digest(renderer),
            "files": {file.name: digest(file) for file in files}}


def regress_identity(options, program):
    if not options.references.is_dir():
        raise Refusal(f"--references {options.references}: no such folder")
    return {"kind": "regress", "references": str(options.references.absolute()), "options": options.passed,
            "tyndall-regress": digest(program), "files": {options.list.name: digest(options.list)}}


def compare(folder, kept, wanted):
    for key in wanted:
        if kept.get(key) == wanted[key]:
            continue
        what = f"{key} {json.dumps(kept.get(key))}, not {json.dumps(wanted[key])}"
        if key == "files":
            what = "other contents of " + ", ".join(name for name in wanted[key]
                                                    if (kept.get(key) or {}).get(name) != wanted[key][name])
        elif key.startswith("tyndall-"):
            what = f"another build of {key}"
        raise Refusal(f"{folder}: was made with {what}: name another folder by --out")


# ----------------------------------------------------------------------------------------------------------------------
# The folder


def require_writable(folder):
    if not folder.is_dir():
        raise Refusal(f"{folder}: cannot be written: it is no folder")
    # Nothing is forbidden to root, but a folder that nobody may write is meant to stay as it is.
    if not stat.S_IMODE(folder.stat().st_mode) & 0o222 or not os.access(folder, os.W_OK | os.X_OK):
        raise Refusal(f"{folder}: cannot be written: it is write-protected")


def is_known(folder, wanted):
    """Whether the folder holds a run of these; refuses any other that is not empty."""
    require_writable(next(each for each in (folder, *folder.parents) if os.path.lexists(each)))
    if not folder.exists():
        return False
    if not (folder / MANIFEST).exists():
        if any(folder.iterdir()):
            raise Refusal(f"{folder}: is not empty, and no folder of submit.py's: it lacks {MANIFEST}")
        return False
    try:
        kept = json.loads(read(folder / MANIFEST))
        if not isinstance(kept, dict):
            raise ValueError
    except ValueError:
        raise Refusal(f"{folder / MANIFEST}: is damaged: name another folder by --out") from None
    compare(folder, kept, wanted)
    return True


def prepare(folder, manifest, subfolders):
    try:
        for name in ("", "log", *subfolders):
            (folder / name).mkdir(parents=True, exist_ok=True)
        unfinished = folder / f".{MANIFEST}.{os.getpid()}"
        try:
            unfinished.write_text(json.dumps(manifest, indent=2) + "\n")
            unfinished.replace(folder / MANIFEST)
        finally:
            unfinished.unlink(missing_ok=True)
    except OSError as error:
        raise Refusal(f"{error.filename}: cannot be written: {error.strerror}") from None


# ----------------------------------------------------------------------------------------------------------------------
# Slurm


def slurm(command):
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    except FileNotFoundError:
        raise Refusal(f"Slurm's {command[0]} is not found: submit from a machine of a cluster; --dry-run needs none"
                      ) from None
    if done.returncode != 0:
        lines = done.stderr.strip().splitlines() or ["no reason given"]
        raise Refusal(f"{command[0]} failed: {lines[-1]}")
    return done.stdout.strip()


def job_name(folder):
    path = str(folder.resolve())
    return f"tyndall-{folder.resolve().name}-{hashlib.sha256(path.encode()).hexdigest()[:8]}"


def submit(options, folder, task, last):
    """The array and the job after it; prints their numbers."""
    common = ["sbatch", "--parsable", "--requeue", "--open-mode=append", f"--job-name={job_name(folder)}",
              *options.sbatch]
    array = [*common, f"--array=1-{options.tasks}", f"--output={folder}/log/task-%A_%a.log", str(HERE / "task.sh"),
             str(options.tasks), *task]
    after = [*common, "--dependency=afterany:ARRAY", f"--output={folder}/log/{last[0]}-%j.log",
             str(HERE / f"{last[0]}.sh"), *last[1:]]
    if options.dry_run:
        print(shlex.join(array), shlex.join(after), sep="\n")
        return
    array_job = slurm(array).split(";")[0]
    try:
        last_job = slurm([word.replace("afterany:ARRAY", f"afterany:{array_job}") for word in after]).split(";")[0]
    except Refusal:
        slurm(["scancel", array_job])
        raise
    print(f"job {array_job}: {options.tasks} tasks; job {last_job}: the {last[0]}; both write to {folder}/log")


def require_idle(folder):
    jobs = slurm(["squeue", "--noheader", "--me", f"--name={job_name(folder)}", "--format=%i"]).split()
    if jobs:
        raise Refusal(f"{folder}: jobs still work on it: {' '.join(jobs)}: wait for them, or scancel them")


# ----------------------------------------------------------------------------------------------------------------------
# What is submitted


def check_by_renderer(command):
    """Lets tyndall-render judge its options, before anything is drawn: all frames are missing."""
    done = subprocess.run([*command, "--missing"], capture_output=True, text=True, check=False)
    if done.returncode == 2:
        raise usage(done.stderr.splitlines()[0])
    if done.returncode != 1 or done.stderr:
        raise usage(f"tyndall-render {shlex.join(command[1:])}: renders nothing")


def film(options, resubmit):
    refuse_options(options.passed, "tyndall-render", "--frames", "--out", "--stats", "--share", "--resume", "--missing")
    renderer = tool("tyndall-render", options.bin)
    identity = film_identity(options, renderer)
    folder = options.out.absolute()
    known = is_known(folder, identity)
    frames = options.frames
    command = [renderer, str(options.scene.absolute()), *options.passed, "--frames", f"{frames[0]}-{frames[-1]}"]
    for kind in identity["pictures"]:
        command += ["--out", f"{folder}/frames/%04d.{kind}"]
    if not known:
        check_by_renderer(command)
    options.tasks = min(options.tasks, len(frames))
    last = ["film", str(folder), options.film, str(frames[0]), str(len(frames)), resubmit, *command]
    return identity, ["frames"], command, last


def regress(options, resubmit):
    refuse_options(options.passed, "tyndall-regress", "--references", "--scenes", "--out", "--share", "--resume",
                   "--force", "--only")
    program = tool("tyndall-regress", options.bin)
    identity = regress_identity(options, program)
    folder = options.out.absolute()
    is_known(folder, identity)
    where = [str(options.list.absolute()), "--references", str(options.references.absolute()), "--out",
             f"{folder}/results"]
    if options.scenes:
        where += ["--scenes", str(options.scenes.absolute())]
    last = ["report", str(folder), resubmit, program, "report", *where]
    return identity, ["results"], [program, "check", *where, *options.passed], last


def run(arguments):
    options = parse(arguments)
    resubmit = f"cd {shlex.quote(os.getcwd())} && {shlex.join([str(Path(__file__).resolve()), *arguments])}"
    manifest, subfolders, task, last = {"film": film, "regress": regress}[options.kind](options, resubmit)
    folder = options.out.absolute()
    if not options.dry_run:
        require_idle(folder)
        prepare(folder, manifest, subfolders)
    submit(options, folder, task, last)


def main():
    try:
        run(sys.argv[1:])
    except Refusal as refusal:
        print(f"submit.py: {refusal}", file=sys.stderr)
        return refusal.status
    return 0


if __name__ == "__main__":
    sys.exit(main())
