# SPDX-License-Identifier: BSD-3-Clause
"""The wheel's page on PyPI: its links work there, where no files of the repository are."""
import importlib.metadata
import pathlib
import re
import sys
import unittest

TOP = pathlib.Path(__file__).parents[2]
sys.path.insert(0, str(TOP / "Utilities"))
from pypi_readme import with_absolute_links  # noqa: E402

LINK = re.compile(r"\]\(([^)]+)\)")


class Page(unittest.TestCase):
    def test_it_begins_with_how_to_install_the_wheel(self):
        page = importlib.metadata.metadata("tipp").get_payload()
        self.assertTrue(page.startswith("# TIPP\n"))
        self.assertLess(page.index("pip install tipp"), 500)

    def test_it_has_no_relative_links(self):
        page = importlib.metadata.metadata("tipp").get_payload()
        self.assertEqual([], [link for link in LINK.findall(page) if not re.match("https?://", link)])

    def test_links_lead_to_the_repository_and_pictures_to_their_files(self):
        text = "[a](b/c.md) ![d](e.png) [f](https://g.org)"
        expected = "[a](https://h.org/o/n/blob/main/b/c.md) ![d](https://h.org/o/n/raw/main/e.png) [f](https://g.org)"
        self.assertEqual(expected, with_absolute_links(text, "https://h.org/o/n/blob/main"))

    def test_without_a_repository_links_become_their_texts(self):
        self.assertEqual("a\n\nf", with_absolute_links("[a](b/c.md)\n\n![d](e.png)\n\nf", ""))

    def test_its_links_name_files_of_the_repository(self):
        text = (TOP / "Plugins/Wheel/README.md").read_text(encoding="utf-8")
        paths = [link for link in LINK.findall(text) if not re.match("https?://", link)]
        self.assertGreater(len(paths), 5)
        self.assertEqual([], [path for path in paths if not (TOP / path.split("#")[0]).exists()])


if __name__ == "__main__":
    unittest.main()
