"""The page of a history, read by Python's parser: well-formed elements, nothing loaded, charts with words for screen readers.

usage: read_shop_page.py PAGE.html
"""

import base64
import hashlib
import re
import sys
from html.parser import HTMLParser

VOID = {"meta", "br", "img", "link", "input", "hr"}


class Page(HTMLParser):
    def __init__(self):
        super().__init__()
        self.open, self.charts, self.ids, self.headings, self.symbols, self.bars, self.style = [], 0, set(), [], 0, 0, ""

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        assert not {"src", "href", "onload", "onclick", "style"} & set(values), (tag, values)
        assert tag not in {"script", "link", "iframe", "object", "img"}, tag
        if "id" in values:
            assert values["id"] not in self.ids, values["id"]
            self.ids.add(values["id"])
        if tag == "svg" and values.get("class") == "chart":
            assert values["role"] == "img" and values["aria-label"], values
            self.charts += 1
        if tag == "th":
            assert values["scope"] == "col"
        self.bars += tag == "rect" and values.get("class") == "bar"
        self.symbols += tag == "title" and len(self.open) > 1 and self.open[-1] in {"circle", "path"} | {"rect"}
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        assert tag in {"line", "path", "circle", "rect"}, tag

    def handle_endtag(self, tag):
        assert self.open and self.open.pop() == tag, (tag, self.open)

    def handle_data(self, data):
        if self.open and self.open[-1] == "style":
            self.style += data


text = open(sys.argv[1], encoding="utf-8").read()
page = Page()
page.feed(text)
assert not page.open, page.open
assert {"trends", "causes", "programs", "outliers", "runs"} <= page.ids, page.ids
assert page.charts >= 4 and page.symbols >= 40 and page.bars >= 1, (page.charts, page.symbols, page.bars)
policy = re.search(r"style-src '(sha256-[^']+)'", text).group(1)
assert policy == "sha256-" + base64.b64encode(hashlib.sha256(page.style.encode()).digest()).decode(), "the style is not the one of the policy"
assert "prefers-color-scheme:dark" in page.style
assert not re.search(r"https?://", text), "names an address"
print(page.charts, "charts,", page.symbols, "symbols")
