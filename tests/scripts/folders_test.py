"""The folders of the sources: their includes point down, none is too large to look through, and headers include few."""

import pathlib
import re
import unittest

SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
TOP_FOLDERS = ("math", "texture", "terrain", "ocean", "lod", "raster", "sky", "scene", "shapes", "mesh_import",
               "render", "capi", "tools", "apps")
MOST_FILES = 45  # in a folder with sources
MOST_HEADERS = 60  # of ours that one includes, with all that these include; but for these, which compose:
COMPOSING = {"render/workspace.h", "render/shade/shade_material-inl.h", "render/materials/river-inl.h",
             "render/materials/terrain-inl.h", "render/tile/attenuate-inl.h", "render/water/topside-inl.h",
             "render/water/underside-inl.h", "render/water/water-inl.h"}


def sources(folders=TOP_FOLDERS):
    return [file for top in folders for file in sorted((SOURCE / top).rglob("*")) if file.suffix in (".h", ".cpp")]


def includes_between_folders():
    """{folder: {folder: an include that leads there}}, as paths from the source folder."""
    arrows = {}
    for file in sources():
        folder = file.parent.relative_to(SOURCE).as_posix()
        for include in re.findall(r'^#include "([^"]+)"', file.read_text(), re.MULTILINE):
            there = pathlib.PurePosixPath(include).parent.as_posix()
            if (SOURCE / include).exists() and there != folder:
                arrows.setdefault(folder, {})[there] = f"{file.relative_to(SOURCE)} includes {include}"
    return arrows


def folders_from_below():
    """The folders of render/ in the order of docs/understand/frame.md; "" is what lies in none."""
    table = (SOURCE / "docs/understand/frame.md").read_text().split("### The folders, from below")[1].split("\n\n")[2]
    names = [name.strip() for row in re.findall(r"^\| ([\w/., ]+) \|", table, re.MULTILINE)[1:] for name in row.split(",")]
    return list(dict.fromkeys(name.removesuffix("/") if name.endswith("/") else "" for name in names))


def headers_included():
    """{header: how many of ours it includes, with all that these include}."""
    direct = {}
    for file in sources():
        if file.suffix == ".h":
            includes = re.findall(r'^#include "([^"]+)"', file.read_text(), re.MULTILINE)
            direct[file.relative_to(SOURCE).as_posix()] = [there for there in includes if (SOURCE / there).exists()]

    def all_of(header):
        found, ways = set(), [header]
        while ways:
            for there in direct.get(ways.pop(), ()):
                if there not in found:
                    found.add(there)
                    ways.append(there)
        return found

    return {header: len(all_of(header)) for header in direct}


def find_circle(arrows):
    """The includes of a circle, or none."""
    done = set()

    def walk(folder, way):
        if folder in way:
            circle = way[way.index(folder):] + [folder]
            return [arrows[a][b] for a, b in zip(circle, circle[1:])]
        if folder not in done:
            for there in arrows.get(folder, ()):
                if circle := walk(there, way + [folder]):
                    return circle
            done.add(folder)
        return []

    return next(filter(None, (walk(folder, []) for folder in arrows)), [])


class Folders(unittest.TestCase):
    def test_includes_form_no_circle(self):
        arrows = includes_between_folders()
        self.assertIn("render/world", arrows["render"])
        self.assertEqual(find_circle(arrows), [])

    def test_a_circle_of_three_is_found(self):
        arrows = {"a": {"b": "a to b"}, "b": {"c": "b to c"}, "c": {"d": "c to d", "b": "c to b"}}
        self.assertEqual(find_circle(arrows), ["b to c", "c to b"])
        del arrows["c"]["b"]
        self.assertEqual(find_circle(arrows), [])

    def test_those_of_render_include_only_what_lies_below(self):
        order = folders_from_below()
        self.assertLess(order.index("water"), order.index("materials"))
        within = {(folder.removeprefix("render").strip("/"), there.removeprefix("render").strip("/")): include
                  for folder, arrows in includes_between_folders().items() for there, include in arrows.items()
                  if folder.split("/")[0] == there.split("/")[0] == "render"}
        self.assertEqual({folder for arrow in within for folder in arrow}, set(order))
        self.assertEqual([include for (folder, there), include in within.items()
                          if order.index(there) > order.index(folder)], [])

    def test_none_has_too_many_files(self):
        folders = {file.parent for file in sources(TOP_FOLDERS + ("tests", "examples"))}
        files = {folder.relative_to(SOURCE).as_posix(): sum(file.is_file() for file in folder.iterdir())
                 for folder in folders}
        for large in ("render/view", "scene/file", "tests/render/shaders"):
            self.assertGreater(files[large], 20)
        self.assertEqual({folder: count for folder, count in files.items() if count > MOST_FILES}, {})

    def test_headers_include_few(self):
        counts = headers_included()
        self.assertGreater(counts["render/workspace.h"], MOST_HEADERS)
        self.assertEqual({header for header, count in counts.items() if count > MOST_HEADERS}, COMPOSING)


if __name__ == "__main__":
    unittest.main()
