"""The documents: docs/, README.md, CONTRIBUTING.md, CHANGELOG.md.

  scripts/docs.sh count             words, pages and pictures by shelf, against their limits; exits with 1 over one
  scripts/docs.sh check             dead links, anchors and paths, pages that the index lacks; exits with 1 at any
  scripts/docs.sh options           writes docs/look_up/options.md anew, from the --help of the programs
  scripts/docs.sh site OUT          makes the pages of a web site, with the references of the interfaces

`options` takes the programs of --programs FOLDER (build/release/bin), `site` the reference of --build FOLDER
(build/release). Words are those of `wc -w`.
"""
import argparse
import functools
import os
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
ABOVE = ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")
MOST_WORDS, MOST_README_WORDS, MOST_PICTURE_MB = 35_000, 900, 12.0

PICTURES = (".png", ".svg", ".jpg", ".gif")
SOURCES = (".h", ".cpp", ".c", ".py", ".pyi", ".sh", ".cmake", ".toml", ".in", ".dox", ".yml")
SOURCE_NAMES = ("CMakeLists.txt", "run")
LINK = re.compile(r"!?\[(?:[^\[\]]|\[[^\[\]]*\])*\]\(\s*([^()\s]+)(?:\s+\"[^\"]*\")?\s*\)")
PICTURE_IN_LINK = re.compile(r"!\[[^\[\]]*\]\(\s*([^()\s]+)(?:\s+\"[^\"]*\")?\s*\)")
HTML_LINK = re.compile(r"<(?:img|a)\b[^>]*?\b(?:src|href)=\"([^\"]+)\"")
PATH = re.compile(r"(?<![\w.*{}$-])/?((?:docs|tests|scenes)/[\w./-]*\w)(?![\w/]*[*{%<$])")


# ---- Pages

def pages(root=ROOT):
    """The documents, those above docs/ first."""
    return [root / name for name in ABOVE if (root / name).exists()] + sorted((root / "docs").rglob("*.md"))


def words(path):
    return len(path.read_text().split())


def without_code(text):
    """A text as long, with spaces for fenced blocks and x for what is in code spans."""
    lines, fence = [], ""
    for line in text.split("\n"):
        mark = re.match(r"\s*(```+|~~~+)", line)
        if fence:
            fence = "" if mark and mark[1].startswith(fence) else fence
            line = " " * len(line)
        elif mark:
            fence = mark[1]
            line = " " * len(line)
        lines.append(line)
    return re.sub(r"(`+)(?!`)(.+?)(?<!`)\1(?!`)", lambda span: re.sub(r"[^\n]", "x", span[0]), "\n".join(lines))


def links(page):
    """[(line, target)] of links and pictures."""
    text = without_code(page.read_text())
    found = {(match.start(1), match[1])
             for pattern in (LINK, PICTURE_IN_LINK, HTML_LINK) for match in pattern.finditer(text)}
    return [(text.count("\n", 0, place) + 1, target) for place, target in sorted(found)]


def is_elsewhere(target):
    return re.match(r"[a-z][a-z0-9+.-]*:", target) is not None


def anchor_of(heading):
    """As GitHub makes it, and the site."""
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading.strip())
    return re.sub(r"[^\w\- ]", "", text.lower()).replace(" ", "-")


def anchors(page):
    """Of its headings; one that comes again has a number."""
    found, text = {}, page.read_text()
    bare = without_code(text).split("\n")
    for line, code in zip(text.split("\n"), bare):
        if heading := code.startswith("#") and re.match(r"#{1,6}\s+(.*?)\s*#*$", line):
            anchor = anchor_of(heading[1])
            found[anchor] = found.get(anchor, -1) + 1
    return {anchor if i == 0 else f"{anchor}-{i}" for anchor, most in found.items() for i in range(most + 1)}


# ---- Faults

def dead_links(root=ROOT):
    faults, anchors_of = [], functools.cache(anchors)
    for page in pages(root):
        for line, target in links(page):
            if is_elsewhere(target):
                continue
            path, _, anchor = target.partition("#")
            there = pathlib.Path(os.path.normpath(page.parent / path)) if path else page
            place = f"{page.relative_to(root)}:{line}: {target}"
            if not there.exists():
                faults.append(f"{place}: no such file")
            elif anchor and (there.suffix != ".md" or anchor not in anchors_of(there)):
                faults.append(f"{place}: no such heading")
    return faults


def targets(page):
    """The files that it links or shows."""
    return {pathlib.Path(os.path.normpath(page.parent / target.partition("#")[0]))
            for _, target in links(page) if not is_elsewhere(target)}


def pages_off_the_index(root=ROOT):
    index = root / "docs/index.md"
    named = targets(index) if index.exists() else set()
    return [page.relative_to(root).as_posix() for page in pages(root)
            if page.is_relative_to(root / "docs") and page != index and page not in named]


def pictures(root=ROOT):
    return sorted(file for file in (root / "docs").rglob("*") if file.suffix in PICTURES)


def pictures_not_shown(root=ROOT):
    shown = set().union(*map(targets, pages(root)))
    return [file.relative_to(root).as_posix() for file in pictures(root) if file not in shown]


def sources(root=ROOT):
    """Files of code, but for what is built and what other people wrote."""
    for folder, folders, names in os.walk(root):
        folders[:] = sorted(name for name in folders if (not name.startswith(".") or name == ".ci")
                            and not (folder == str(root) and name in ("build", "out", "docs")))
        for name in sorted(names):
            if name.endswith(SOURCES) or name in SOURCE_NAMES:
                yield pathlib.Path(folder, name)


def stale_paths(root=ROOT):
    """Paths in code that begin with docs/, tests/ or scenes/ and lead nowhere; those outside of comments only if they
    name a page, because code makes and takes many others."""
    faults = []
    for file in sources(root):
        mark = "//" if file.suffix in (".h", ".cpp", ".c", ".dox") else "#"
        for number, line in enumerate(file.read_text(errors="replace").split("\n"), 1):
            comment = line.find(mark) if "/*" not in line and not line.lstrip().startswith("*") else 0
            for match in PATH.finditer(line):
                in_comment = 0 <= comment < match.start()
                path = match[1]
                leads = (root / path).exists() or (file.parent / path).exists()
                is_pattern = re.search("[A-Z]{3,}", path)
                is_file = path.endswith(".md") or (in_comment and "." in path.rsplit("/", 1)[1])
                if is_file and not is_pattern and not leads:
                    faults.append(f"{file.relative_to(root)}:{number}: {path}")
    return faults


# ---- Commands

def count(root=ROOT, out=sys.stdout):
    """Prints the sizes. Whether they are within their limits."""
    shelves = {}
    for page in pages(root):
        if page.is_relative_to(root / "docs"):
            shelf = page.parent.relative_to(root).as_posix()
            shelves.setdefault(shelf, []).append(words(page))
    all_words, readme = sum(map(sum, shelves.values())), words(root / "README.md")
    size_mb = sum(file.stat().st_size for file in pictures(root)) / 1e6
    print("                      pages    words", file=out)
    for shelf, counts in shelves.items():
        print(f"{shelf:20} {len(counts):6} {sum(counts):8}", file=out)
    print(f"{'docs in all':20} {sum(map(len, shelves.values())):6} {all_words:8}   at most {MOST_WORDS}", file=out)
    print(f"{'README.md':20} {'':6} {readme:8}   at most {MOST_README_WORDS}", file=out)
    print(f"{'pictures':20} {len(pictures(root)):6} {size_mb:8.1f} MB, at most {MOST_PICTURE_MB:.0f}", file=out)
    for file in pictures_not_shown(root):
        print(f"no page shows {file}", file=out)
    for page in pages_off_the_index(root):
        print(f"docs/index.md lacks {page}", file=out)
    return all_words <= MOST_WORDS and readme <= MOST_README_WORDS and size_mb <= MOST_PICTURE_MB


def check(root=ROOT):
    """Prints what is wrong. Whether all is right."""
    faults = dead_links(root) + stale_paths(root)
    faults += [f"docs/index.md lacks {page}" for page in pages_off_the_index(root)]
    for fault in faults:
        print(fault)
    return not faults


def main(arguments):
    parser = argparse.ArgumentParser(prog="scripts/docs.sh", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    commands.add_parser("count", help="words, pages, pictures, limits")
    commands.add_parser("check", help="dead links and paths")
    options = commands.add_parser("options", help="docs/look_up/options.md from the programs")
    options.add_argument("--programs", metavar="FOLDER", type=pathlib.Path, default=ROOT / "build/release/bin")
    site = commands.add_parser("site", help="a web site of the pages")
    site.add_argument("out", metavar="OUT", type=pathlib.Path, help="its folder, which is made anew")
    site.add_argument("--build", metavar="FOLDER", type=pathlib.Path, default=ROOT / "build/release",
                      help="a configured build, for the reference of C and C++ by Doxygen")
    arguments = parser.parse_args(arguments)
    if arguments.command == "count":
        return 0 if count() else 1
    if arguments.command == "check":
        return 0 if check() else 1
    if arguments.command == "options":
        import docs_options
        (ROOT / docs_options.PAGE).write_text(docs_options.page(arguments.programs))
        return 0
    import docs_site
    return docs_site.make(arguments.out, arguments.build)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
