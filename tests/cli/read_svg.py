"""read_svg.py FILE images COUNT REGEX...: the file is well-formed SVG with so many embedded PNGs, and each regex is found in
one of its texts."""

import base64
import re
import sys
import xml.etree.ElementTree as tree

SVG = "{http://www.w3.org/2000/svg}"
XLINK = "{http://www.w3.org/1999/xlink}"

root = tree.parse(sys.argv[1]).getroot()
assert root.tag == SVG + "svg" and root.get("viewBox"), root.tag
images = [image.get(XLINK + "href") for image in root.iter(SVG + "image")]
assert len(images) == int(sys.argv[3]), f"{len(images)} images"
for image in images:
    kind, data = image.split(",", 1)
    assert kind == "data:image/png;base64", kind
    assert base64.b64decode(data, validate=True)[:8] == b"\x89PNG\r\n\x1a\n"
texts = ["".join(text.itertext()) for text in root.iter(SVG + "text")]
for wanted in sys.argv[4:]:
    assert any(re.search(wanted, text) for text in texts), f"no text has {wanted}: {texts}"
