"""A JUnit report by the rules of the schema that Jenkins publishes (xunit-plugin, junit-10.xsd), read by Python's parser.

usage: read_junit.py REPORT.xml SUITES FAILURES ERRORS
"""

import sys
import xml.etree.ElementTree as ElementTree

ATTRIBUTES = {"testsuite": ({"name", "tests", "failures", "errors"}, set()), "testcase": ({"name"}, {"classname", "time"}),
              "failure": (set(), {"type", "message"}), "error": (set(), {"type", "message"}),
              "testsuites": (set(), {"name"}), "system-out": (set(), set())}
CHILDREN = {"testsuites": {"testsuite"}, "testsuite": {"testcase", "system-out"}, "testcase": {"failure", "error"},
            "failure": set(), "error": set(), "system-out": set()}


def check(element):
    required, optional = ATTRIBUTES[element.tag]
    assert required <= set(element.attrib) <= required | optional, (element.tag, element.attrib)
    for child in element:
        assert child.tag in CHILDREN[element.tag], (element.tag, child.tag)
        check(child)


root = ElementTree.parse(sys.argv[1]).getroot()
assert root.tag == "testsuites"
check(root)
for suite in root:
    for tag, key in (("failure", "failures"), ("error", "errors"), ("testcase", "tests")):
        assert len(list(suite.iter(tag))) == int(suite.attrib[key]), (suite.attrib, key)
counts = [len(root), len(list(root.iter("failure"))), len(list(root.iter("error")))]
assert counts == [int(word) for word in sys.argv[2:]], counts
