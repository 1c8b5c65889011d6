"""The documents: no dead link, no page that the index lacks, sizes within their limits, options as the programs have them.

SWELL_PROGRAMS is the folder of the programs; without it the page of options is not compared.
"""

import io
import os
import pathlib
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(SOURCE / "scripts"))

import docs          # noqa: E402 the path comes first
import docs_options  # noqa: E402


class Documents(unittest.TestCase):
    def test_links_lead_to_files_and_headings(self):
        self.assertEqual(docs.dead_links(), [])
        self.assertGreater(sum(len(docs.links(page)) for page in docs.pages()), 100)

    def test_the_index_names_every_page(self):
        self.assertEqual(docs.pages_off_the_index(), [])

    def test_every_picture_is_shown(self):
        self.assertEqual(docs.pictures_not_shown(), [])

    def test_sizes_are_within_their_limits(self):
        out = io.StringIO()
        self.assertTrue(docs.count(out=out), out.getvalue())

    def test_paths_in_code_lead_to_files(self):
        self.assertEqual(docs.stale_paths(), [])
        self.assertGreater(len(list(docs.sources())), 500)

    @unittest.skipUnless("SWELL_PROGRAMS" in os.environ, "needs the programs: SWELL_PROGRAMS")
    def test_options_are_what_the_programs_print(self):
        page = docs_options.page(pathlib.Path(os.environ["SWELL_PROGRAMS"]))
        self.assertEqual((SOURCE / docs_options.PAGE).read_text(), page, "scripts/docs.sh options writes it anew")


class Tree(unittest.TestCase):
    """A repository of its own for each case."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        self.write("README.md", "[all](docs/index.md)\n")
        self.write("docs/index.md", "# All\n\n[A page](do/films.md)\n")
        self.write("docs/do/films.md", "# A page\n")

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


class DeadLinks(Tree):
    def faults(self, text):
        self.write("docs/do/films.md", text)
        return [fault.split(": ", 1)[1] for fault in docs.dead_links(self.root)]

    def test_files_and_pictures_have_to_be_there(self):
        self.assertEqual(self.faults("[a](../index.md) [b](none.md)\n\n![c](../images/none.png)\n"),
                         ["none.md: no such file", "../images/none.png: no such file"])

    def test_a_picture_that_is_a_link_counts_twice(self):
        self.assertEqual(self.faults("[![c](none.png)](gone.md)"), ["none.png: no such file", "gone.md: no such file"])

    def test_anchors_are_those_of_headings(self):
        text = "# A `key` (m)\n\n## Twice\n\n## Twice\n\n```\n# no heading\n```\n"
        self.assertEqual(self.faults(text + "[a](#a-key-m) [b](films.md#twice-1) [c](../index.md#all)"), [])
        self.assertEqual(self.faults(text + "[a](#no-heading) [b](#twice-2)"),
                         ["#no-heading: no such heading", "#twice-2: no such heading"])

    def test_code_has_no_links(self):
        self.assertEqual(self.faults("`[a](none.md)`\n\n```\n[b](none.md)\n```\n\n[`c`](none.md)"), ["none.md: no such file"])

    def test_addresses_elsewhere_are_not_asked(self):
        self.assertEqual(self.faults("[a](https://example.org/none.md) [b](mailto:a@example.org)"), [])


class Counts(Tree):
    def test_words_are_those_of_wc(self):
        self.write("docs/do/films.md", "# A page\n\n| a | b |\n`x` y\tz\n")
        self.assertEqual(docs.words(self.root / "docs/do/films.md"), 11)

    def test_too_much_of_anything_is_said(self):
        self.assertTrue(docs.count(self.root, io.StringIO()))
        self.write("README.md", "word " * (docs.MOST_README_WORDS + 1))
        self.assertFalse(docs.count(self.root, io.StringIO()))
        self.write("README.md", "word")
        self.write("docs/do/films.md", "word " * docs.MOST_WORDS)
        self.assertFalse(docs.count(self.root, io.StringIO()))

    def test_what_nobody_finds_is_named(self):
        self.write("docs/images/lone.png", "")
        self.write("docs/do/browser.md", "# Lost\n")
        out = io.StringIO()
        docs.count(self.root, out)
        self.assertIn("no page shows docs/images/lone.png", out.getvalue())
        self.assertIn("docs/index.md lacks docs/do/browser.md", out.getvalue())


class StalePaths(Tree):
    def faults(self, name, text):
        self.write(name, text)
        return [fault.rsplit(": ", 1)[1] for fault in docs.stale_paths(self.root)]

    def test_comments_name_files_that_are_there(self):
        gone = "docs/" + "gone.md"
        self.assertEqual(self.faults("a.h", f"// docs/index.md, {gone} and scenes/none.toml.\n"), [gone, "scenes/none.toml"])

    def test_strings_may_name_files_to_be_made_but_no_pages(self):
        gone = "docs/" + "gone.md"
        self.assertEqual(self.faults("a.cpp", f'f("scenes/none.toml"); g(ROOT "/{gone}");\n'), [gone])

    def test_patterns_and_folders_pass(self):
        self.assertEqual(self.faults("a.py", "# tests/NAME_test.cpp, tests/*.cpp, scenes/{name}.toml, docs/do\n"), [])


class OptionsPage(unittest.TestCase):
    HELP = ("Draws.\nUsage: a [OPTIONS]\n\nOptions:\n"
            "  -h,--help                   Print this help message and exit\n"
            "  --threads N=7               Threads\n"
            "  --set KEY=VALUE ...         Give a key a value\n"
            "  --time X=0 Excludes: --frames\n"
            "                              Of a single picture\n"
            "  --every N=1 Needs: --frames Draw every N-th\n"
            "  --scene FILE REQUIRED       A|B\n"
            "  --centre X Y x 2            Middle\n")

    def test_an_option_has_a_name_a_default_a_meaning_and_conditions(self):
        description, options, modes = docs_options.read_help(self.HELP)
        self.assertEqual((description, modes), ("Draws.", []))
        self.assertEqual([tuple(option) for option in options],
                         [("--threads N", "all CPUs", "Threads", ()), ("--set KEY=VALUE ...", "", "Give a key a value", ()),
                          ("--time X", "0", "Of a single picture", ("not with `--frames`",)),
                          ("--every N", "1", "Draw every N-th", ("needs `--frames`",)),
                          ("--scene FILE", "", "A|B", ("required",)), ("--centre X Y", "", "Middle", ())])

    def test_what_programs_share_stands_once(self):
        other = self.HELP.replace("  --every N=1 Needs: --frames Draw every N-th\n", "  --own                       Its own, as --every\n")
        page = docs_options.compose({"one": self.HELP, "two": other})
        self.assertEqual(page.count("Give a key a value"), 1)
        self.assertIn("As above: `--threads`, `--set`, `--time` (not with `--frames`), `--scene` (required), `--centre`.", page)
        self.assertIn("## two\n\nDraws.\n\nAs above: ", page)
        self.assertIn("\n`--own` |  | Its own, as `--every`\n", page)
        self.assertIn("A\\|B", page)


if __name__ == "__main__":
    unittest.main()
