"""Compares two pages of `clsurf report` byte for byte, except for the picture of the part in a field (the first of each
page after the defect map), which it writes as PNG files.

usage: split_page.py A.html B.html A.png B.png
"""

import base64
import re
import sys


def split(page, picture):
    text = open(page, encoding="utf-8").read()
    found = re.search(r'<img alt="(?!Defects")[^"]*" src="data:image/png;base64,([^"]+)"', text)
    open(picture, "wb").write(base64.b64decode(found.group(1)))
    return text[: found.start(1)] + text[found.end(1) :]


assert split(sys.argv[1], sys.argv[3]) == split(sys.argv[2], sys.argv[4]), "the pages differ"
