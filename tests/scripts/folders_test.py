"""The folders of the sources: their includes point down, and none is too large to look through."""

import pathlib
import re
import unittest

SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
TOP_FOLDERS = ("math", "texture", "terrain", "ocean", "lod", "raster", "sky", "scene", "shapes", "mesh_import",
               "render", "capi", "tools", "apps")
MOST_FILES = 45  # in a folder with sources


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

    def test_none_has_too_many_files(self):
        folders = {file.parent for file in sources(TOP_FOLDERS + ("tests", "examples"))}
        files = {folder.relative_to(SOURCE).as_posix(): sum(file.is_file() for file in folder.iterdir())
                 for folder in folders}
        for large in ("render/view", "scene/file", "tests/render/shaders"):
            self.assertGreater(files[large], 20)
        self.assertEqual({folder: count for folder, count in files.items() if count > MOST_FILES}, {})


if __name__ == "__main__":
    unittest.main()
