"""The site of the documents: its pages' links lead somewhere, and a browser shows them whole, without help from elsewhere.

  site_test.py [Case ...]
SITE_PICTURES=FOLDER in the environment: writes there what the browser shows.
"""

import functools
import html.parser
import http.server
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import urllib.parse

SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(SOURCE / "scripts"))

import docs       # noqa: E402 the path comes first
import docs_site  # noqa: E402

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.by import By
except ImportError:
    webdriver = None

PHONE, DESK = (390, 844), (1280, 800)
ON_A_DESK = ("index.html", "learn/first_picture.html", "look_up/scene.html", "understand/frame.html")


class ForTheSite(unittest.TestCase):
    def test_links_out_of_the_pages_lead_to_copies(self):
        linked = set()
        text = docs_site.for_site("[a](../../scenes/beach.toml#x) [b](../look_up/scene.md#keys) [c](#here) [d](../../README.md)\n"
                                  "![e](../images/e.png) `[f](../../f)` [g](https://example.org/)", "docs/do/films.md", linked)
        self.assertEqual(text, "[a](../files/scenes/beach.toml.txt#x) [b](../look_up/scene.md#keys) [c](#here) "
                               "[d](../about/readme.md)\n![e](../images/e.png) `[f](../../f)` [g](https://example.org/)")
        self.assertEqual(linked, {"scenes/beach.toml"})
        self.assertEqual(docs_site.for_site("[a](docs/do/films.md)", "README.md", linked), "[a](../do/films.md)")

    def test_lists_are_indented_by_four(self):
        self.assertEqual(docs_site.indent_lists("text\n- one\n  more\n\n  ```sh\n  a\n    b\n  ```\n- two\n\n    code\n"),
                         "text\n\n- one\n    more\n\n    ```sh\n    a\n      b\n    ```\n- two\n\n    code\n")
        self.assertEqual(docs_site.indent_lists("- one\n\nend\n  no list\n"), "- one\n\nend\n  no list\n")

    def test_navigation_is_that_of_the_index(self):
        self.assertEqual(docs_site.navigation("# A\n\n## Do: one thing\n\n- [B](do/b.md): c\n- [D](do/d.md)\n"),
                         [{"All pages": "index.md"}, {"Do": [{"B": "do/b.md"}, {"D": "do/d.md"}]}])

    def test_python_names_have_signatures_and_docstrings(self):
        page = docs_site.python_reference(SOURCE / "python/swell")
        self.assertIn("### World.foam\n\n```python\nWorld.foam(xy: npt.ArrayLike, t: float) -> ", page)
        self.assertIn("### Camera.K\n\n```python\nCamera.K: np.ndarray\n", page)
        self.assertIn("### Picture[...]\n\n```python\nPicture[label: str] -> np.ndarray\n", page)
        self.assertNotIn("_ask", page)
        self.assertIn("A key of scene files ([scene.md](../look_up/scene.md)).\n", page)

    def test_python_classes_have_what_makes_them_and_their_fields(self):
        page = docs_site.python_reference(SOURCE / "python/swell")
        self.assertRegex(page, r"## World\n\n```python\nWorld\(\n    scene: .* = '',\n    \*,\n    set: .* = \(\),\n")
        self.assertIn("- **threads**: that a picture", page)
        self.assertIn("- `id: int`: In the label \"id\".\n", page)
        self.assertIn("- `t`: Its time in seconds.\n", page)
        self.assertLessEqual(max(len(line) for block in page.split("```python")[1:]
                                 for line in block.split("```")[0].split("\n")), 85)

    def test_comments_of_headers_are_doxygens(self):
        header = ('// A `T`.\n//\n//   f<T>("\\n");  // one\n//     g();\n//\n// End.\n#pragma once\n\n// Of f.\n//\n//   f();\n'
                  'void f();  // it <T>\n#endif  // H\n')
        comments = subprocess.run(["sed", "-E", "-f", SOURCE / "cmake/comments.sed"], input=header, capture_output=True,
                                  text=True, check=True).stdout
        self.assertEqual([line.rstrip() for line in comments.splitlines()],
                         [r"/// \file", "/// A <tt>T</tt>.", "///", '/// <pre>  f&lt;T&gt;("\\n");  // one', "///     g();",
                          "/// </pre>", "/// End.", "#pragma once", "", "/// Of f.", "///", "/// <pre>  f();", "/// </pre>",
                          "void f();  ///< it <T>", "#endif  // H"])

    def test_words_and_long_cells_are_marked(self):
        long = "word " * 9
        self.assertEqual(docs_site.mark(f"<p><code>--set</code> <code>a b</code></p><td>1</td><td>{long}</td>"),
                         f'<p><code class="word">--set</code> <code>a b</code></p><td>1</td><td class="long">{long}</td>')
        self.assertEqual(docs_site.mark("<code>a --b c</code> <pre><span></span><code>a --b\n</code></pre>"),
                         '<code>a <span class="word">--b</span> c</code> '
                         '<pre><span></span><code>a <span class="word">--b</span>\n</code></pre>')
        self.assertEqual(docs_site.mark("<pre><code><i>-</i>-x <i> </i>c</code></pre>"),
                         '<pre><code><i>-</i><span class="word">-x</span> <i> </i>c</code></pre>')

    def test_powers_are_raised_outside_code(self):
        self.assertEqual(docs_site.mark("<p>2^24, x^\u22120.3. 10^(0.5 m) <code>a^2 b</code> X^y</p><pre>a^2</pre>"),
                         "<p>2<sup>24</sup>, x<sup>\u22120.3</sup>. 10<sup>0.5 m</sup> <code>a^2 b</code> X^y</p><pre>a^2</pre>")


class Page(html.parser.HTMLParser):
    """Title, ids, and what it links and loads."""

    def __init__(self, path):
        super().__init__()
        self.title, self.ids, self.targets, self.in_title = "", set(), [], False
        self.feed(path.read_text())

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.in_title = tag == "title"
        self.ids |= {attributes[name] for name in ("id", "name") if attributes.get(name)}
        self.targets += [attributes[name] for name in ("href", "src") if attributes.get(name)]

    def handle_data(self, data):
        if self.in_title:
            self.title += data

    def handle_endtag(self, tag):
        self.in_title = False


@unittest.skipUnless(shutil.which("mkdocs"), "needs mkdocs")
class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.temporary.cleanup)
        cls.site = pathlib.Path(cls.temporary.name, "site")
        assert docs_site.make(cls.site, None) == 0

    def pages(self):
        return [docs_site.place_on_site(page.relative_to(SOURCE).as_posix()).removesuffix("md") + "html" for page in docs.pages()]

    def test_its_links_lead_to_files_and_places(self):
        read = functools.cache(Page)
        faults = []
        for name in [*self.pages(), "reference/python.html"]:
            for target in read(self.site / name).targets:
                address = urllib.parse.urlsplit(target)
                if address.scheme or address.netloc:
                    continue
                there = pathlib.Path(os.path.normpath((self.site / name).parent / urllib.parse.unquote(address.path))
                                     if address.path else self.site / name)
                if there.is_dir():
                    there /= "index.html"
                place = urllib.parse.unquote(address.fragment)
                if not there.exists() or (place and there.suffix == ".html" and place not in read(there).ids):
                    faults.append(f"{name}: {target}")
        self.assertEqual(faults, [])

    def test_pages_have_titles_and_are_found(self):
        index = json.loads((self.site / "search/search_index.json").read_text())
        found = {entry["location"] for entry in index["docs"]}
        for name in self.pages():
            self.assertRegex(Page(self.site / name).title, r"\w+.* - Swell|^Swell", name)
            self.assertIn(name, found)

    @unittest.skipUnless(webdriver and shutil.which("chromedriver"), "needs chromedriver and python3-selenium")
    def test_a_browser_shows_them_whole_on_phone_and_desk(self):
        handler = functools.partial(QuietHandler, directory=self.site)
        with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
            threading.Thread(target=server.serve_forever, daemon=True).start()
            self.address = f"http://127.0.0.1:{server.server_port}/"
            self.browser = start_browser(self.temporary.name)
            try:
                for (width, height), names in [(PHONE, [*self.pages(), "reference/python.html"]), (DESK, ON_A_DESK)]:
                    self.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
                        "width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600})
                    for name in names:
                        with self.subTest(name, width=width):
                            self.look_at(name, width)
                self.search_for("fetch")
                self.look_at_logs()
            finally:
                self.browser.quit()
                server.shutdown()

    def look_at(self, name, width):
        self.browser.get(self.address + name)
        self.assertIn("Swell", self.browser.title)
        if "SITE_PICTURES" in os.environ:
            self.browser.save_screenshot(f"{os.environ['SITE_PICTURES']}/{name.replace('/', '_')}_{width}.png")
        wide = self.browser.execute_script("return [document.documentElement.scrollWidth, innerWidth]")
        self.assertLessEqual(wide[0], wide[1])
        broken = self.browser.execute_script(
            "return [...document.images].filter(one => one.complete && !one.naturalWidth).map(one => one.src)")
        self.assertEqual(broken, [])
        cut_off = self.browser.execute_script(
            "return [...document.querySelectorAll('pre > code')].filter(one => one.scrollWidth > one.clientWidth + 1)"
            ".map(one => one.textContent)")
        self.assertEqual(cut_off, [])

    def search_for(self, word):
        self.browser.get(self.address + "index.html")
        # What is typed before the index has been read is never answered, nor is anything after it.
        for _ in range(200):
            if "Initializing" not in self.browser.execute_script("return document.querySelector('.md-search-result__meta').textContent"):
                break
            time.sleep(0.1)
        self.browser.execute_script(
            "const query = document.querySelector('[data-md-component=search-query]');"
            "query.focus(); query.value = arguments[0]; query.dispatchEvent(new KeyboardEvent('keyup', {bubbles: true}))", word)
        self.browser.implicitly_wait(20)
        self.assertTrue(self.browser.find_elements(By.CSS_SELECTOR, ".md-search-result__item a"), "nothing is found")

    def look_at_logs(self):
        self.assertEqual([entry for entry in self.browser.get_log("browser") if entry["level"] == "SEVERE"], [])
        calls = [json.loads(entry["message"])["message"] for entry in self.browser.get_log("performance")]
        asked = {call["params"]["request"]["url"] for call in calls if call["method"] == "Network.requestWillBeSent"}
        self.assertGreater(len(asked), 20)
        self.assertEqual([url for url in asked if re.match("(http|ws|ftp)s?:", url) and not url.startswith(self.address)], [])


class QuietHandler(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


def start_browser(folder):
    options = webdriver.ChromeOptions()
    for argument in ("headless=new", "no-sandbox", "disable-gpu", "disable-dev-shm-usage", "user-data-dir=" + folder + "/browser",
                     "host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1"):
        options.add_argument("--" + argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    return webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)


if __name__ == "__main__":
    unittest.main()
