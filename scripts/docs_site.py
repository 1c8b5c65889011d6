"""The site: the documents as Markdown for mkdocs in a folder of their own, and what they link beside them.

A page of docs/ keeps its place; those above docs/ go to about/. A link that leaves the documents leads to a copy of the
file as text, below files/. Navigation is that of docs/index.md. Python's reference is made of the docstrings; that of C
and C++, by Doxygen, is copied where a build can make it.
"""
import ast
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import docs

# Of python/swell what is public.
PACKAGE = ("__init__.py", "below.py", "camera.py", "disturbance.py", "distortion.py", "lidar.py")
LIST_ITEM = re.compile(r"( *)(?:[-*+]|\d+\.) ")
TARGET = re.compile(r"(?<=\]\()\s*([^()\s]+)|(?<=src=\")([^\"]+)|(?<=href=\")([^\"]+)")
POWER = re.compile(r"<(code|pre|script|title)\b.*?</\1>|<[^>]*>|\^(?:\(([^)]*)\)|([-\u2212]?[\d.]*\d))", re.DOTALL)
CSS = """.md-typeset h1, .md-typeset h2 { color: inherit; font-weight: 600; letter-spacing: 0; }
.md-grid { max-width: 72rem; }
/* Wide tables and long words scroll or break in place, never the page. */
.md-typeset code { overflow-wrap: break-word; }
/* A line of code that is too long goes on below, indented, and leaves room for the button that copies. */
.md-typeset pre > code { padding-right: 2.6em; white-space: pre-wrap; overflow-wrap: anywhere; }
.md-typeset pre > code > span[id] { display: block; padding-left: 2em; text-indent: -2em; }
.md-typeset pre .c1 { display: inline-block; text-indent: 0; }
.md-typeset table:not([class]) th { min-width: 0; }
.md-typeset table:not([class]) td, .md-typeset table:not([class]) th { padding: .5em .75em; }
.md-typeset table:not([class]) code { word-break: normal; overflow-wrap: normal; }
.md-typeset table:not([class]) td:first-child code, .md-typeset .word { white-space: nowrap; }
.md-typeset table:not([class]) td.long { min-width: 11rem; }
.md-typeset table:not([class]) td.long:nth-child(n+6) { min-width: 7rem; }
.md-typeset table:not([class]) td > img { min-width: 7rem; }
/* Room for code and tables, which the names of pages do not need. */
@media screen and (min-width: 76.25em) { .md-sidebar--primary { width: 8.5rem; } }
.md-typeset sup { line-height: 0; }
/* A heading's link takes no line of its own. */
.md-content { overflow-x: clip; }
.md-typeset :is(h1, h2, h3) { position: relative; }
.md-typeset .headerlink { position: absolute; margin-left: .2rem; }
/* Links that are read as easily as the text around them. */
[data-md-color-scheme="default"] { --md-typeset-a-color: #00796b; }
[data-md-color-scheme="slate"] { --md-typeset-a-color: #4db6ac; }
"""


# ---- Pages

def place_on_site(path):
    """Of a file of the repository, by its path there."""
    if path.startswith("docs/"):
        return path.removeprefix("docs/")
    if path in docs.ABOVE:
        return f"about/{path.lower()}"
    return f"files/{path}.txt"


def for_site(text, path, linked):
    """A document's text as mkdocs takes it; adds to `linked` the files that it needs besides."""
    here = place_on_site(path)

    def move(match):
        target = next(filter(None, match.groups()))
        if docs.is_elsewhere(target) or target.startswith("#"):
            return match[0]
        file, anchor = re.match(r"([^#]*)(.*)", target).groups()
        there = os.path.normpath(os.path.join(os.path.dirname(path), file))
        if not there.startswith("docs/") and there not in docs.ABOVE:
            linked.add(there)
        return os.path.relpath(place_on_site(there), os.path.dirname(here) or ".") + anchor

    pieces, at = [], 0
    for match in TARGET.finditer(docs.without_code(text)):
        pieces += [text[at:match.start()], move(match)]
        at = match.end()
    return indent_lists("".join(pieces) + text[at:])


def indent_lists(text):
    """GitHub's lists as Python's Markdown reads them: a blank line before, and four spaces before what belongs to an
    item."""
    lines, shift, fence, in_list, before = [], 0, "", False, ""
    for line in text.split("\n"):
        indent = len(line) - len(line.lstrip(" "))
        mark = re.match(r" *(```+)", line)
        if fence:
            lines.append(" " * (shift if line else 0) + line)
            if line.strip() == fence:
                fence = ""
        else:
            item = LIST_ITEM.match(line)
            if item and not in_list and before.strip():
                lines.append("")
            in_list = bool(item) or in_list and not (line.strip() and indent == 0 and not before.strip())
            shift = 0 if not in_list or not line.strip() else 4 - indent if indent in (2, 3) else 2 if indent >= 6 else 0
            fence = mark[1] if mark else ""
            lines.append(" " * shift + line)
        before = line
    return "\n".join(lines)


def copy_of(path):
    """A linked file as text; of a folder, what lies in it."""
    file = docs.ROOT / path
    if file.is_dir():
        return "".join(f"{path}/{name}\n" for name in sorted(os.listdir(file)) if not name.startswith((".", "__")))
    return file.read_text(errors="replace")


def navigation(index):
    """mkdocs's, of the headings and items of docs/index.md."""
    shelves = [{"All pages": "index.md"}]
    for line in index.split("\n"):
        if line.startswith("## "):
            shelves.append({line[3:].split(":")[0]: []})
        elif match := re.match(r"- \[([^\]]+)\]\(([^)]+)\)", line):
            next(iter(shelves[-1].values())).append({match[1]: match[2]})
    return shelves


# ---- References

def python_reference(folder):
    """A page of the package's public names, with what their docstrings say."""
    sources = {name: ast.parse((folder / name).read_text()) for name in PACKAGE}
    public = next(ast.literal_eval(node.value) for node in sources["__init__.py"].body
                  if isinstance(node, ast.Assign) and node.targets[0].id == "__all__")
    text = f"# Python\n\n{in_markdown(ast.get_docstring(sources['__init__.py']))}\n"
    for tree in sources.values():
        for node in tree.body:
            if getattr(node, "name", None) in public:
                text += describe(node)
    return text


def in_markdown(docstring):
    """Its arguments as a list, and the pages that it names as links."""
    docstring = re.sub(r"\bdocs/((?:\w+/)*(\w+\.md))", r"[\2](../\1)", docstring)
    return indent_lists(re.sub(r"^([a-z]\w*(?:, \w+)*(?: \([^)]*\))?): ", r"- **\1**: ", docstring, flags=re.MULTILINE))


def signature(name, function):
    """Of a call, on one line if that is short, else a line for each argument."""
    arguments = function.args
    arguments.args = [argument for argument in arguments.args if argument.arg not in ("self", "cls")]
    result = f") -> {ast.unparse(function.returns)}" if function.returns else ")"
    line = f"{name}({ast.unparse(arguments)}{result}"
    if len(line) <= 85:
        return line
    pieces = [ast.unparse(argument) for argument in arguments.args + arguments.kwonlyargs]
    defaults = [None] * (len(arguments.args) - len(arguments.defaults)) + arguments.defaults + arguments.kw_defaults
    pieces = [f"{piece} = {ast.unparse(default)}" if default else piece for piece, default in zip(pieces, defaults)]
    if arguments.kwonlyargs:
        pieces.insert(len(arguments.args), "*")
    return "\n".join([f"{name}(", *(f"    {piece}," for piece in pieces), result])


def fields_of(members):
    """A class's attributes as a list, with what is said of each below it."""
    text = ""
    for member, after in zip(members, [*members[1:], None]):
        if isinstance(member, ast.AnnAssign):
            name = ast.unparse(member)
        elif isinstance(member, ast.Assign):
            name = ast.unparse(member.targets[0]).removeprefix("self.")
        else:
            continue
        said = isinstance(after, ast.Expr) and isinstance(after.value, ast.Constant) and after.value.value
        if not name.startswith("_") and (said or isinstance(member, ast.AnnAssign)):
            text += f"- `{name}`: {said}\n" if said else f"- `{name}`\n"
    return f"\n{text}" if text else ""


def describe(node, within=""):
    name, mark = within + node.name, "###" if within else "##"
    members = node.body if isinstance(node, ast.ClassDef) else []
    begin = next((member for member in members if getattr(member, "name", "") == "__init__"), None)
    if members:
        head = signature(name, begin) if begin and ast.get_docstring(begin) else ""
    elif any(ast.unparse(decorator).endswith("property") for decorator in node.decorator_list):
        head = f"{name}: {ast.unparse(node.returns)}"
    else:
        head = signature(name, node)
        if node.name == "__getitem__":
            name, head = within[:-1] + "[...]", re.sub(r"\.__getitem__\((.*)\) ->", r"[\1] ->", head)
    text = f"\n{mark} {name}\n" + (f"\n```python\n{head}\n```\n" if head else "")
    for said in filter(None, [ast.get_docstring(node), begin and ast.get_docstring(begin)]):
        text += f"\n{in_markdown(said)}\n"
    text += fields_of(members) + (fields_of(begin.body) if begin else "")
    for member in members:
        if isinstance(member, ast.FunctionDef) and (not member.name.startswith("_") or member.name == "__getitem__"):
            text += describe(member, within=name + ".")
    return text


def make_c_reference(build, out):
    """By Doxygen, if it is there and a build is configured. Whether it is made."""
    if not shutil.which("doxygen") or not (build / "Doxyfile").exists():
        print(f"note: no reference of C and C++: it needs doxygen, and {build} configured", file=sys.stderr)
        return False
    settings = (build / "Doxyfile").read_text() + f'\nOUTPUT_DIRECTORY = "{out.parent}"\nHTML_OUTPUT = {out.name}\n'
    subprocess.run(["doxygen", "-"], input=settings, text=True, check=True)
    return True


# ---- What style sheets cannot see

def mark(html):
    """A page whose words in code do not break at their hyphens, whose cells of much text are known to be so, and whose
    powers are raised."""
    def words(text):
        return re.sub(r"(?<!\S)[^\s-]{0,30}-\S{1,30}(?!\S)", r'<span class="word">\g<0></span>', text)

    def code(match):
        if re.fullmatch(r"\S{1,30}", match[1]):
            return f'<code class="word">{match[1]}</code>'
        return f"<code>{words(match[1])}</code>"

    html = re.sub(r"(?<!</span>)<code>([^<]+)</code>", code, html)
    html = re.sub(r"<pre>.*?</pre>", lambda block: re.sub(r"(?<=>)[^<]+", lambda text: words(text[0]), block[0]), html,
                  flags=re.DOTALL)
    html = re.sub(r"<td>(.*?)</td>", lambda cell: f'<td class="long">{cell[1]}</td>'
                  if len(re.sub(r"<[^>]*>", "", cell[1])) > 40 else cell[0], html, flags=re.DOTALL)
    return POWER.sub(lambda match: match[0] if match[0][0] == "<" else f"<sup>{match[2] or match[3]}</sup>", html)


# ---- The whole

def assemble(folder, build=None):
    """Writes what mkdocs takes: FOLDER/mkdocs.json and FOLDER/pages."""
    pages, linked = folder / "pages", set()

    def write(name, text):
        path = pages / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    for page in docs.pages():
        path = page.relative_to(docs.ROOT).as_posix()
        write(place_on_site(path), for_site(page.read_text(), path, linked))
    for picture in set().union(*map(docs.targets, docs.pages())) & set(docs.pictures()):
        there = pages / place_on_site(picture.relative_to(docs.ROOT).as_posix())
        there.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(picture, there)
    for path in linked:
        write(place_on_site(path), copy_of(path))
    write("site.css", CSS)
    write("reference/python.md", python_reference(docs.ROOT / "python/swell"))
    reference = [{"Python": "reference/python.md"}]
    if build and make_c_reference(build, pages / "reference/c"):
        write("reference/c_and_cpp.md", "# C and C++\n\n[All functions and structures](c/index.html), by Doxygen.\n")
        reference.append({"C and C++": "reference/c_and_cpp.md"})
    about = [{path.stem.capitalize(): place_on_site(path.name)} for path in docs.pages() if path.name in docs.ABOVE]
    (folder / "mkdocs.json").write_text(json.dumps({
        "INHERIT": str(docs.ROOT / "mkdocs.yml"), "docs_dir": str(pages),
        "nav": [*navigation((docs.ROOT / "docs/index.md").read_text()), {"Reference": reference}, {"About": about}]}))


def make(out, build):
    """The site's folder, anew. An exit code."""
    if not shutil.which("mkdocs"):
        print("error: mkdocs, got none, allowed the packages of scripts/setup.sh docs", file=sys.stderr)
        return 2
    with tempfile.TemporaryDirectory() as folder:
        assemble(pathlib.Path(folder), build)
        code = subprocess.run(["mkdocs", "build", "--quiet", "--config-file", f"{folder}/mkdocs.json",
                               "--site-dir", out.resolve()], check=False).returncode
        for name in pathlib.Path(folder, "pages").rglob("*.md"):
            page = (out / name.relative_to(f"{folder}/pages")).with_suffix(".html")
            if page.exists():
                page.write_text(mark(page.read_text()))
        return code
