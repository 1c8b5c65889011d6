"""The page of all options, made of what the programs print with --help.

An option that several of them have, in the same words, stands in a first table and is named below by each of its
programs.
"""
import collections
import re
import subprocess
import typing

PAGE = "docs/look_up/options.md"
PROGRAMS = ("swell-render", "swell-view", "swell-dataset", "swell-sim", "swell-bench")
COLUMN = 30  # where the help's descriptions begin
ALWAYS = ("-h,--help", "--version")

OPENING = """# Options

<!-- made by scripts/docs.sh options from what the programs print with --help -->

For whoever calls a program: every option with its default and meaning. Each program prints its own with `--help`, as
does each mode of `swell-bench`, and its version with `--version`. Exit codes: 0 done; 2 bad options, scene or file,
with one line that says what was given and what is allowed; 1 anything else. Files are whole or not there, also when a
signal ends the program.
"""


class Option(typing.NamedTuple):
    name: str     # with what follows it
    default: str
    meaning: str
    notes: tuple  # what it needs and excludes

    def plain(self):
        return self._replace(notes=())

    def short(self):
        return f"`{self.name.split(' ')[0]}`"


def read_help(text):
    """(description, [Option], [modes]) of CLI11's help."""
    lines = text.split("\n")
    usage = next(i for i, line in enumerate(lines) if line.startswith("Usage:"))
    options, modes, section = [], [], ""
    at = usage + 1
    while at < len(lines):
        line = lines[at]
        at += 1
        if not line.startswith("  "):
            section = line.strip().rstrip(":") or section
            continue
        head, meaning = line[:COLUMN].strip(), line[COLUMN:].strip()
        if lines[at].startswith(" " * COLUMN):  # a long head has its meaning below
            head, meaning = line.strip(), lines[at].strip()
            at += 1
        if section == "Subcommands":
            modes.append(head)
        elif head.split(" ")[0] not in ALWAYS:
            options.append(read_option(head, meaning))
    return " ".join(lines[:usage]).strip(), options, modes


def read_option(head, meaning):
    """Of `--fps X=60 Needs: --frames`."""
    head, *conditions = re.split(r" (?=(?:Needs|Excludes):)", head)
    notes = ["required"] if head.endswith(" REQUIRED") else []
    head = re.sub(r" x \d+$", "", head.removesuffix(" REQUIRED"))
    match = re.fullmatch(r"(.*?)=([^A-Z].*)", head)
    name, default = match.groups() if match else (head, "")
    if name.startswith("--threads"):
        default = "all CPUs"  # as many as the machine has that prints it
    for condition in conditions:
        kind, names = condition.split(": ")
        others = ", ".join(f"`{other}`" for other in names.split())
        notes.append(("needs " if kind == "Needs" else "not with ") + others)
    return Option(name, default, meaning, tuple(notes))


def in_markdown(text):
    """With options as code, and without what would end a cell."""
    return re.sub(r"(?<![\w-])--[a-z][\w-]*", r"`\g<0>`", text).replace("|", "\\|")


def table(options):
    def row(option):
        end = "" if option.meaning[-1] in ".?" else "."
        notes = "".join(f" {note[0].upper()}{note[1:]}." for note in option.notes)
        meaning = in_markdown(option.meaning) + (end + notes if notes else "")
        return f"`{option.name}` | {option.default} | {meaning}"
    return "\n".join(["option | default | meaning", "---|---|---", *map(row, options)]) + "\n"


def list_shared(shared, common):
    """Options of the table `common` as a list, four and more that follow each other there by the first and last."""
    runs = []
    for option in sorted(shared, key=lambda option: common.index(option.plain())):
        before = runs[-1][-1] if runs else None
        if before and not before.notes and not option.notes and \
                common.index(option.plain()) == common.index(before.plain()) + 1:
            runs[-1].append(option)
        else:
            runs.append([option])

    def text(option):
        return option.short() + (f" ({', '.join(option.notes)})" if option.notes else "")
    return ", ".join(f"{text(run[0])} to {text(run[-1])}" if len(run) > 3 else ", ".join(map(text, run)) for run in runs)


def compose(helps):
    """The page, of {a program, or one and its mode: its help's text}."""
    read = {name: read_help(text) for name, text in helps.items()}
    read = {name: parts for name, parts in read.items() if parts[1]}
    users = collections.Counter(option.plain() for _, options, _ in read.values() for option in options)
    common = [option for option, count in users.items() if count > 1]
    text = OPENING + "\n## Options of several programs\n\n" + table(common)
    for name, (description, options, _) in read.items():
        shared = [option for option in options if option.plain() in common]
        own = [option for option in options if option.plain() not in common]
        text += f"\n## {name}\n\n{in_markdown(description.rstrip('.'))}.\n"
        text += f"\nAs above: {list_shared(shared, common)}.\n" if shared else ""
        text += "\n" + table(own) if own else ""
    return text


def help_of(folder, *call):
    return subprocess.run([folder / call[0], *call[1:], "--help"], check=True, capture_output=True, text=True).stdout


def page(folder):
    """What the programs of a folder have."""
    helps = {}
    for program in PROGRAMS:
        helps[program] = help_of(folder, program)
        for mode in read_help(helps[program])[2]:
            helps[f"{program} {mode}"] = help_of(folder, program, mode)
    return compose(helps)
