"""What the README and the pages tell to type works: their blocks ```sh and ```python run, page by page.

  docs_blocks_test.py Blocks       the pages' blocks, but for those that a line <!-- slow --> precedes
  docs_blocks_test.py SlowBlocks   all blocks of the pages that have a slow one, and of SLOW_PAGES
  docs_blocks_test.py Reading      how blocks are found

A line <!-- not run --> before a block leaves it out. Blocks of a page run in their order, in one folder with the
scenes/ and examples/ of the repository, and its Python blocks know the names of those before. Sequences and data sets
are shorter than the page says.
SWELL_PROGRAMS is the folder of the programs, SWELL_PACKAGE that of the Python package and SWELL_PYTHON its interpreter;
without the first nothing runs, without the others no Python.
"""

import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import textwrap
import time
import unittest

SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(SOURCE / "scripts"))

import docs  # noqa: E402 the path comes first

SLOW_PAGES = ("docs/learn/first_scene.md",  # a walk whose steps need each other: eight pictures of an island
              "docs/do/coasts_and_rivers.md")  # an archipelago
MOST_FRAMES, MOST_SAMPLES = 3, 3

RUN_ALL = """
import json, subprocess, sys
names = {"__name__": "__main__"}
for page, line, language, code in json.load(open(sys.argv[1])):
    print(f"== {page}:{line}", flush=True)
    if language == "python":
        exec(compile("\\n" * line + code, page, "exec"), names)
    else:
        subprocess.run(["bash", "-euo", "pipefail", "-c", code], check=True)
"""


def read_blocks(text):
    """[(line, language, mark, code)] of the blocks of shell and Python; the mark is "", "slow" or "not run"."""
    blocks, mark, fence = [], "", None
    for number, line in enumerate(text.split("\n"), 1):
        if fence:
            if line.strip() == fence:
                if language in ("sh", "python"):
                    blocks.append((begin, language, mark, textwrap.dedent("\n".join(code)) + "\n"))
                fence, mark = None, ""
            else:
                code.append(line)
        elif match := re.match(r"\s*(```+)(\w*)", line):
            fence, language, begin, code = match[1], match[2], number, []
        elif line.strip():
            match = re.fullmatch(r"<!-- (slow|not run) -->", line.strip())
            mark = match[1] if match else ""
    return blocks


def chosen_blocks(text, slow, is_slow_page=False):
    """Those that the fast tier runs, or the slow one."""
    blocks = [block for block in read_blocks(text) if block[2] != "not run"]
    if slow:
        return blocks if is_slow_page or any(mark == "slow" for _, _, mark, _ in blocks) else []
    return [] if is_slow_page else [block for block in blocks if block[2] != "slow"]


def shorten(text):
    """Code or a recipe with fewer frames and samples."""
    text = re.sub(r"(--frames )(\d+)-(\d+)",
                  lambda found: f"{found[1]}{found[2]}-{min(int(found[3]), int(found[2]) + MOST_FRAMES - 1)}", text)
    return re.sub(r"(?m)^(count *= *)(\d+)", lambda found: f"{found[1]}{min(int(found[2]), MOST_SAMPLES)}", text)


def lay_out(work):
    """What pages expect in the folder where they are followed."""
    os.symlink(SOURCE / "examples", work / "examples")
    (work / "scenes/recipes").mkdir(parents=True)
    for file in (SOURCE / "scenes").iterdir():
        if file.name != "recipes":
            os.symlink(file, work / "scenes" / file.name)
    for recipe in (SOURCE / "scenes/recipes").iterdir():
        (work / "scenes/recipes" / recipe.name).write_text(shorten(recipe.read_text()))


def run_page(page, slow):
    """(seconds, what it printed or None if all went well)."""
    name = page.relative_to(SOURCE).as_posix()
    python, package = os.environ.get("SWELL_PYTHON"), os.environ.get("SWELL_PACKAGE")
    blocks = [(name, line, language, shorten(code))
              for line, language, _, code in chosen_blocks(page.read_text(), slow, name in SLOW_PAGES)
              if language == "sh" or (python and package)]
    if not blocks:
        return 0.0, None
    begin = time.monotonic()
    with tempfile.TemporaryDirectory() as tools, tempfile.TemporaryDirectory() as work:
        lay_out(pathlib.Path(work))
        os.symlink(python or sys.executable, pathlib.Path(tools, "python3"))
        pathlib.Path(tools, "blocks.json").write_text(json.dumps(blocks))
        environment = dict(os.environ, PATH=f"{tools}:{os.environ['SWELL_PROGRAMS']}:{os.environ['PATH']}",
                           PYTHONPATH=package or "", PYTHONDONTWRITEBYTECODE="1")
        try:
            run = subprocess.run([python or sys.executable, "-c", RUN_ALL, f"{tools}/blocks.json"], cwd=work,
                                 env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                 stderr=subprocess.STDOUT, text=True, timeout=300 if slow else 60, check=False)
            failed, said = run.returncode != 0, run.stdout
        except subprocess.TimeoutExpired as late:
            failed, said = True, (late.stdout or b"").decode() + f"\nnot done after {late.timeout} s"
    return time.monotonic() - begin, said if failed else None


class AllPages(unittest.TestCase):
    def run_all(self, slow):
        if "SWELL_PROGRAMS" not in os.environ:
            self.skipTest("needs the programs: SWELL_PROGRAMS")
        pages = docs.pages()
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            runs = dict(zip(pages, pool.map(lambda page: run_page(page, slow), pages)))
        for page, (seconds, said) in runs.items():
            if seconds:
                print(f"{seconds:5.1f} s {page.relative_to(SOURCE)}")
            with self.subTest(page.name):
                self.assertIsNone(said, said)


class Blocks(AllPages):
    def test_those_of_every_page_run(self):
        self.run_all(slow=False)


class SlowBlocks(AllPages):
    def test_those_of_pages_with_a_slow_one_run(self):
        self.run_all(slow=True)


class Reading(unittest.TestCase):
    TEXT = ("# A\n\n```sh\none\n```\n\n<!-- not run -->\n```sh\nnever\n```\n\n<!-- slow -->\n\n```python\nlong = 1\n```\n"
            "- in a list\n\n  ```python\n  if one:\n    two()\n  ```\n\n```toml\n[sea]\n```\n")

    def test_a_block_has_a_line_a_language_a_mark_and_its_code(self):
        self.assertEqual(read_blocks(self.TEXT), [
            (3, "sh", "", "one\n"), (8, "sh", "not run", "never\n"), (14, "python", "slow", "long = 1\n"),
            (19, "python", "", "if one:\n  two()\n")])

    def test_tiers_choose_by_the_mark(self):
        self.assertEqual([line for line, *_ in chosen_blocks(self.TEXT, slow=False)], [3, 19])
        self.assertEqual([line for line, *_ in chosen_blocks(self.TEXT, slow=True)], [3, 14, 19])
        self.assertEqual([line for line, *_ in chosen_blocks(self.TEXT, True, is_slow_page=True)], [3, 14, 19])
        self.assertEqual(chosen_blocks(self.TEXT, False, is_slow_page=True), [])
        self.assertEqual(chosen_blocks("```sh\none\n```\n", slow=True), [])

    def test_slow_pages_are_there(self):
        self.assertLessEqual({SOURCE / name for name in SLOW_PAGES}, set(docs.pages()))

    def test_sequences_and_data_sets_are_short(self):
        self.assertEqual(shorten("a --frames 0-89 --fps 30 --frames 7-8\ncount = 100\nfirst_count = 9\n"),
                         "a --frames 0-2 --fps 30 --frames 7-8\ncount = 3\nfirst_count = 9\n")


if __name__ == "__main__":
    unittest.main()
