# What a page of `clsurf report` holds, decoded as io/page/page_pack.h says.
#
# read_page.py options PAGE  the options that its command line reads with, for a shell
# read_page.py roles PAGE    a line for each other role: its name and how far its positions lie from those shown, at most [mm]
import base64
import json
import re
import shlex
import sys
import zlib


def column(page, packed):
    """The whole numbers of a packed column."""
    block = re.search(r'id="block-%d">(.*?)</script>' % packed["block"], page, re.S).group(1)
    raw = zlib.decompress(base64.b64decode(block)) if packed["planes"] else b""
    count = packed["count"]
    values = [0] * count
    for plane in range(packed["planes"]):
        for i in range(count):
            values[i] |= raw[plane * count + i] << (8 * plane)
    values = [(v >> 1) ^ -(v & 1) for v in values]
    for _ in range(packed["order"]):
        for i in range(packed["stride"], count):
            values[i] += values[i - packed["stride"]]
    return values


def main():
    page = open(sys.argv[2], encoding="utf-8").read()
    manifest = json.loads(re.search(r'id="manifest">(.*?)</script>', page, re.S).group(1))
    if sys.argv[1] == "options":
        print(shlex.join(manifest["command"]["options"]))
        return
    surface = manifest["surfaces"][0]
    for role in surface["roles"]:
        axes = [column(page, role[axis]) for axis in "xyz"]
        farthest = max(sum(v * v for v in at) ** 0.5 for at in zip(*axes))
        print("%s %.4f" % (role["name"], farthest * surface["position_quantum_mm"]))


main()
