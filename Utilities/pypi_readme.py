# SPDX-License-Identifier: BSD-3-Clause
"""Gives scikit-build-core the text of the wheel's page on PyPI: Plugins/Wheel/README.md with absolute links.

The page shows no files of the repository. TIPP_REPOSITORY is the address of its files, such as
https://HOST/OWNER/NAME/blob/main. Without it, links become their texts, and pictures are left out.
"""
import os
import pathlib
import re

LINK = re.compile(r"(!?)\[([^\]]*)\]\((?!https?://)([^)]+)\)")


def with_absolute_links(text, repository):
    """Returns the text with links that work on any page."""

    def absolute(link):
        is_picture, words, path = link.groups()
        if not repository:
            return "" if is_picture else words
        base = repository.replace("/blob/", "/raw/") if is_picture else repository
        return f"{is_picture}[{words}]({base.rstrip('/')}/{path})"

    return re.sub(r"\n{3,}", "\n\n", LINK.sub(absolute, text))


def dynamic_metadata(field, settings, project=None):
    """Called by scikit-build-core for the field `readme`."""
    if field != "readme" or settings:
        raise ValueError("pypi_readme.py gives the field 'readme' and has no settings.")
    text = pathlib.Path("Plugins/Wheel/README.md").read_text(encoding="utf-8")
    return {"content-type": "text/markdown", "text": with_absolute_links(text, os.environ.get("TIPP_REPOSITORY", ""))}
