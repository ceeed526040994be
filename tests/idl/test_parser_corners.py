"""Odd definitions, and what genmsg makes of them.

The answers in the table are genmsg's: the MD5 sum, or None where it raises an error. A
second test asks the installed genmsg again.
"""

from __future__ import annotations

import json

import pytest

from aioros1.errors import MessageError, MessageSpecError
from aioros1.idl import MessageStore

# kind, what is odd, definition of corner_msgs/Corner, MD5 sum or None
CORNERS: list[tuple[str, str, str, str | None]] = [
    ("msg", "nothing", "", "d41d8cd98f00b204e9800998ecf8427e"),
    ("msg", "only comments", "# a\n  # b\n\n", "d41d8cd98f00b204e9800998ecf8427e"),
    ("msg", "spaces around", "   int32    x   ", "19aac5e823802d733295ea3ec20e6350"),
    ("msg", "tab as the only separator", "string\tb", None),
    ("msg", "tabs around", "\tint32 x\t", "19aac5e823802d733295ea3ec20e6350"),
    ("msg", "tab and space between", "int32 \tx", "19aac5e823802d733295ea3ec20e6350"),
    ("msg", "carriage returns", "int32 x\r\nstring y\r\n", "264abc4b51af402c51554cd8e54874a6"),
    ("msg", "comment behind", "int32 x # comment", "19aac5e823802d733295ea3ec20e6350"),
    ("msg", "comment at once", "int32 x#comment", "19aac5e823802d733295ea3ec20e6350"),
    ("msg", "one word", "int32", None),
    ("msg", "three words", "int32 x y", None),
    ("msg", "vertical tab", "int32\x0bx", None),
    ("msg", "no-break space", "int32 x\xa0", "19aac5e823802d733295ea3ec20e6350"),
    ("msg", "byte order mark", "\ufeffint32 x", None),
    ("msg", "semicolon", "int32 x;", None),
    ("msg", "name with digit first", "int32 1x", None),
    ("msg", "name with underscore first", "int32 _x", None),
    ("msg", "name with underscore last", "int32 x_", "c394d9e7e13d3b5534f0b623cd98aed2"),
    ("msg", "name with dash", "int32 x-y", None),
    ("msg", "name with slash", "int32 x/y", None),
    ("msg", "upper-case name", "int32 X", "9f2e036ba416c06792bf33a8197f7c90"),
    (
        "msg",
        "keyword as name",
        "int32 from\nint32 class\nint32 None",
        "e225f1143b77e8c13cab8c1119c240d9",
    ),
    ("msg", "name twice", "int32 x\nstring x", None),
    ("msg", "same name in other case", "int32 x\nint32 X", "bc0fabc2fbacb971eb2801f54d8b655d"),
    ("msg", "non-ASCII name", "int32 café", "4b0f5e363a417857709dc0019570d24d"),
    (
        "msg",
        "field and constant of one name",
        "int32 x=1\nint32 x",
        "895501e6ad0d2a72214311b7d39db060",
    ),
    ("msg", "constant twice", "int32 X=1\nint32 X=2", "6e0d72d0daf43489a0c0b7611eb04137"),
    (
        "msg",
        "constants behind fields",
        "int32 x\nint32 A=1\nstring s\nint32 B=2",
        "aea62897c8da87f292136cb0f62dd1ef",
    ),
    ("msg", "order of constants", "int32 B=2\nint32 A=1", "3cfc00cdd017709b4ea362cad4bd43ed"),
    ("msg", "array", "int32[] x", "6a729db180c300e2ff66f875b5b0a514"),
    ("msg", "fixed array", "int32[3] x", "54ef8264579f6c94ad00e07335627ad5"),
    ("msg", "array of none", "int32[0] x", "6ee02a7949c16011867642bbf01dbb77"),
    ("msg", "leading zero", "int32[03] x", "409f59708e8ab6c781a7ce1e327e74a5"),
    ("msg", "spaces in brackets", "int32[ 3 ] x", None),
    ("msg", "space before brackets", "int32 [] x", None),
    ("msg", "two dimensions", "int32[][] x", None),
    ("msg", "two fixed dimensions", "int32[2][3] x", None),
    ("msg", "negative length", "int32[-1] x", None),
    ("msg", "signed length", "int32[+1] x", None),
    ("msg", "length with underscore", "int32[1_0] x", None),
    ("msg", "length in Arabic digits", "int32[٣] x", "1a36ce405e6794a96182ffa1931dc69b"),
    ("msg", "superscript length", "int32[²] x", None),
    ("msg", "hexadecimal length", "int32[0x3] x", None),
    ("msg", "bracket not closed", "int32[3 x", None),
    ("msg", "bracket not opened", "int32] x", None),
    ("msg", "behind the bracket", "int32[3]y x", None),
    ("msg", "comma in brackets", "int32[2,3] x", None),
    ("msg", "brackets at the name", "int32 x[3]", None),
    ("msg", "bounded, as in ROS 2", "int32[<=3] x", None),
    ("msg", "bounded string, as in ROS 2", "string<=3 x", None),
    ("msg", "default, as in ROS 2", "int32 x 5", None),
    ("msg", "wstring", "wstring x", None),
    ("msg", "upper-case type", "INT32 x", None),
    (
        "msg",
        "all built-in types",
        (
            "bool a\nint8 b\nuint8 c\nint16 d\nuint16 e\nint32 f\nuint32 g\n"
            "int64 h\nuint64 i\nfloat32 j\nfloat64 k\nstring l\ntime m\nduration n\nchar o\nbyte p"
        ),
        "2ccdfa572641ce79e8de3d105bbece15",
    ),
    (
        "msg",
        "arrays of old names",
        "char[] a\nbyte[] b\nchar[4] c\nbyte[4] d",
        "b7bfb3c4dd13614e1bf40372c0feaf29",
    ),
    ("msg", "header", "Header header", "d7be0bb39af8fb9129d5a76e6b63a290"),
    ("msg", "header by full name", "std_msgs/Header header", "d7be0bb39af8fb9129d5a76e6b63a290"),
    ("msg", "header of another name", "Header h", "2fb230b1c292dc29f6aeb6a8ee50c6d0"),
    ("msg", "header not first", "int32 x\nHeader header", "14d24ac0586ee0a8a89dd2eb8ebed4a0"),
    ("msg", "two headers", "Header a\nHeader b", "7d1b86aad5f706719f82c433a7db02d3"),
    ("msg", "array of headers, short", "Header[] x", None),
    ("msg", "array of headers, in full", "std_msgs/Header[] x", "1802262b876d3adadb8098fed1dc3599"),
    ("msg", "old header", "roslib/Header header", None),
    ("msg", "local type", "Other x", "c0b1539bf3531bc963ee9f30bd411967"),
    (
        "msg",
        "type elsewhere",
        "geometry_msgs/Point p\ngeometry_msgs/Point[] q\ngeometry_msgs/Point[2] r",
        "f2f877e23fcb9e37e6f06cc8fcbd0309",
    ),
    ("msg", "type in a deeper place", "a/b/c x", None),
    ("msg", "type with trailing slash", "std_msgs/ x", None),
    ("msg", "type with leading slash", "/std_msgs/String x", None),
    ("msg", "type with two slashes", "std_msgs//String x", None),
    ("msg", "type with digit first", "1a/B x", None),
    ("msg", "type unknown", "std_msgs/NoSuchType x", None),
    ("msg", "package unknown", "no_such_pkg/String x", None),
    ("msg", "built-in type in a package", "std_msgs/int32 x", None),
    ("msg", "itself", "Corner x", None),
    ("msg", "constant", "int32 X=5", "acd6fbebdce2152560885f592dd664e0"),
    ("msg", "constant with spaces", "int32   X  =   5  ", "acd6fbebdce2152560885f592dd664e0"),
    ("msg", "constant with comment", "int32 X=5 # five", "acd6fbebdce2152560885f592dd664e0"),
    ("msg", "constant without a value", "int32 X=", None),
    ("msg", "constant without a name", "int32 =5", "798f59b0abb319c3a6a8879ae3207c6c"),
    ("msg", "constant without a type", "X=5", None),
    ("msg", "constant with two equals signs", "int32 X=5=6", None),
    ("msg", "constant whose name is two words", "int32 X Y=5", "3599f7a040529089526d5173b3d36510"),
    ("msg", "constant whose value is two words", "int32 X=5 6", None),
    ("msg", "constant of type time", "time X=5", None),
    ("msg", "constant of type duration", "duration X=5", None),
    ("msg", "constant array", "int32[] X=5", None),
    ("msg", "constant of type Header", "Header X=5", None),
    ("msg", "constant of a message type", "std_msgs/String X=5", None),
    ("msg", "integer: negative", "int32 X=-5", "bfd2c332e355e99e8b968eecf551393a"),
    ("msg", "integer: plus", "int32 X=+5", "946de12e0647599323693d399af4b922"),
    ("msg", "integer: leading zeros", "int32 X=007", "c83ce4a29257d7d47f56459ab5ebedea"),
    ("msg", "integer: underscore", "int32 X=1_000", "5a54e5372e6271f2e3a5b909ddeb6128"),
    ("msg", "integer: hexadecimal", "int32 X=0x10", None),
    ("msg", "integer: float", "int32 X=5.0", None),
    ("msg", "integer: exponent", "int32 X=1e3", None),
    ("msg", "integer: letters", "int32 X=abc", None),
    ("msg", "int8 lowest", "int8 X=-128", "d2fd286fc50fafe7000f5957c5e1aafb"),
    ("msg", "int8 too low", "int8 X=-129", None),
    ("msg", "int8 highest", "int8 X=127", "8511d02133899cfc6ab6db346be73631"),
    ("msg", "int8 too high", "int8 X=128", None),
    ("msg", "uint8 highest", "uint8 X=255", "0e40fa323df5356481f72925fc9522bf"),
    ("msg", "uint8 too high", "uint8 X=256", None),
    ("msg", "uint8 negative", "uint8 X=-1", None),
    ("msg", "byte highest", "byte X=127", "b7280906c7e5202cfb9708b7d0ea14c9"),
    ("msg", "byte too high", "byte X=128", None),
    ("msg", "char highest", "char X=255", "c690539b9c4f27b1121a33427949504f"),
    ("msg", "char too high", "char X=256", None),
    ("msg", "char letter", "char X=a", None),
    ("msg", "uint32 highest", "uint32 X=4294967295", "da0c581e65f64ea8a4514c231165928a"),
    ("msg", "uint32 too high", "uint32 X=4294967296", None),
    ("msg", "int64 highest", "int64 X=9223372036854775807", "aa3b1130d29cbd1f4c95f885f5935737"),
    (
        "msg",
        "int64 one too high",
        "int64 X=9223372036854775808",
        "628354d2570df55ab67c1eba15d5c6d4",
    ),
    ("msg", "int64 two too high", "int64 X=9223372036854775809", None),
    ("msg", "int64 lowest", "int64 X=-9223372036854775808", "d64918159c1a4385d6339bbd0e8d9fa6"),
    (
        "msg",
        "int64 one too low",
        "int64 X=-9223372036854775809",
        "e7763a994787ef81f33aea11f2df148d",
    ),
    ("msg", "int64 two too low", "int64 X=-9223372036854775810", None),
    ("msg", "uint64 highest", "uint64 X=18446744073709551615", "ea33ddedce1d9de61af1484f7e01fa25"),
    (
        "msg",
        "uint64 one too high",
        "uint64 X=18446744073709551616",
        "ea629f82faa96ab63d7007e32184c5fb",
    ),
    ("msg", "uint64 two too high", "uint64 X=18446744073709551617", None),
    ("msg", "float", "float64 X=1.5", "1557111d4570d10848ff9747d2fe7c9e"),
    ("msg", "float: whole", "float32 X=1", "fd8197e7063e2c65560ec61deaacf109"),
    ("msg", "float: exponent", "float64 X=-1e-3", "9140010a4bfc6f83c40fb9f3bfb4744e"),
    ("msg", "float: nan", "float64 X=nan", "2e2cb25e28a6bccf2ecf495780d78153"),
    ("msg", "float: inf", "float64 X=-inf", "cb9eda1be83473783253f45fcb54893a"),
    ("msg", "float: suffix", "float32 X=1.0f", None),
    ("msg", "float: hexadecimal", "float64 X=0x1p3", None),
    ("msg", "float: too large for float32", "float32 X=1e300", "f2de459991864bd1030dbf0587517b89"),
    ("msg", "bool: True", "bool X=True", "ee0120bbf6fb15d9d446680aaf955fd3"),
    ("msg", "bool: False", "bool X=False", "57af8ad7910ffed4e045d110a5095e54"),
    ("msg", "bool: 1", "bool X=1", "dd0bf90b8077e3cf4bd4fcf25ce1b84d"),
    ("msg", "bool: 0", "bool X=0", "d06882195cab50343552e38d19f6dad3"),
    ("msg", "bool: 2", "bool X=2", "b74b116aa0b34f872b2c823a80d1ee1a"),
    ("msg", "bool: true", "bool X=true", None),
    ("msg", "bool: quoted", "bool X='false'", "318bb56aab0a5797590988ec52718cf3"),
    ("msg", "bool: list", "bool X=[]", "7d6534fb12c054520273142231c964c4"),
    ("msg", "bool: None", "bool X=None", "d35e8cd03b4f5e136073d0682ff53a63"),
    ("msg", "bool: empty", "bool X=", None),
    ("msg", "bool: expression", "bool X=1+1", None),
    ("msg", "string", "string S=hello", "6efcc8af05984c2c0655a3ffdffa2338"),
    ("msg", "string with spaces", "string S=  hello  world  ", "cde2bca54f4d6adaffc8bac684dcd57f"),
    (
        "msg",
        "string with hash",
        "string S= a # not a comment  ",
        "a7f4b98ccd946fdb587c933a9fa319a2",
    ),
    ("msg", "string with equals sign", "string S=a=b", "b38d8e232c0a4a304a651dca3a584039"),
    ("msg", "string with quotes", 'string S="a"', "643dbdca288444910fda6d7834b21381"),
    ("msg", "string empty", "string S=", "566ef1375c47cb11a4df280ccee921e7"),
    ("msg", "string blank", "string S=    ", "566ef1375c47cb11a4df280ccee921e7"),
    ("msg", "string with tab", "string S=\ta\tb\t", "94ffcfcd37304dc476f0d60842c34ec7"),
    ("msg", "string non-ASCII", "string S=grüße", "f3b1bf523a4c4b13745df863bed49e38"),
    ("msg", "string, indented", "  string S=a", "dd4f522dfed92ae0ed2709debf1e13e0"),
    ("msg", "string, two spaces", "string   S=a", "61abed0f7b24388bd1308793e3ba8d1d"),
    ("msg", "string, space before the sign", "string S =a", "61abed0f7b24388bd1308793e3ba8d1d"),
    ("msg", "string, tab before the name", "string\tS=a", None),
    (
        "msg",
        "string, tab behind the type's space",
        "string \tS=a",
        "61abed0f7b24388bd1308793e3ba8d1d",
    ),
    ("msg", "string, hash in the name", "string S#=a", "9a02b60232a02550a09ec79f096c5dc9"),
    (
        "msg",
        "string, carriage return",
        "string S=a\r\nint32 x\r\n",
        "ecc59caf3c4d3372ae0d00c20391efa0",
    ),
    ("msg", "separator", "int32 a\n---\nint32 b", None),
    ("msg", "page break", "int32 a\x0cint32 b", None),
    ("srv", "both", "int32 a\n---\nint32 b", "25ba3fa9d5d930574c4d72dc4151cd60"),
    ("srv", "empty", "", "d41d8cd98f00b204e9800998ecf8427e"),
    ("srv", "only a separator", "---", "d41d8cd98f00b204e9800998ecf8427e"),
    ("srv", "no separator", "int32 a", "5c9fb1a886e81e3162a5c87bf55c072b"),
    ("srv", "no request", "---\nint32 b", "976c440660ac67ad67b35c9dce4f2065"),
    ("srv", "no response", "int32 a\n---", "5c9fb1a886e81e3162a5c87bf55c072b"),
    ("srv", "four dashes", "int32 a\n----\nint32 b", "25ba3fa9d5d930574c4d72dc4151cd60"),
    (
        "srv",
        "comment behind the dashes",
        "int32 a\n--- # c\nint32 b",
        "25ba3fa9d5d930574c4d72dc4151cd60",
    ),
    (
        "srv",
        "text behind the dashes",
        "int32 a\n---int32 c\nint32 b",
        "25ba3fa9d5d930574c4d72dc4151cd60",
    ),
    ("srv", "space before the dashes", "int32 a\n ---\nint32 b", None),
    (
        "srv",
        "space behind the dashes",
        "int32 a\n---  \nint32 b",
        "25ba3fa9d5d930574c4d72dc4151cd60",
    ),
    ("srv", "two dashes", "int32 a\n--\nint32 b", None),
    (
        "srv",
        "three sections",
        "int32 a\n---\nint32 b\n---\nint32 c",
        "812989c1ece7c05c389b0c6e56bd04ee",
    ),
    ("srv", "one name in both", "int32 a\n---\nint32 a", "2249109ea3d980722f814333081b7ec6"),
    ("srv", "one name in two of three", "int32 a\n---\nint32 b\n---\nint32 b", None),
    ("srv", "constants", "int32 A=1\n---\nint32 B=2\nint32 b", "b9c5ff2420124d68f1c9bd936de331f2"),
    ("srv", "header", "Header header\n---\nHeader header", "3c64cc5ac7e6cbcec5fa7b5ed330b0a6"),
    (
        "srv",
        "types elsewhere",
        "geometry_msgs/Point p\n---\ngeometry_msgs/Pose q",
        "de96f16a071662bd943e38ddcc946bf5",
    ),
    (
        "srv",
        "carriage returns",
        "int32 a\r\n---\r\nint32 b\r\n",
        "25ba3fa9d5d930574c4d72dc4151cd60",
    ),
    ("srv", "error in the response", "int32 a\n---\nint32", None),
]

OTHER = "int32 n\n"  # corner_msgs/Other, a neighbour of the type under test

# Run by the system's Python: prints genmsg's answers to the cases on its input.
ASK_GENMSG = """
import json, sys
from genmsg import gentools, msg_loader

answers = []
places = {name: ["/usr/share/%s/msg" % name] for name in ("std_msgs", "geometry_msgs")}
for kind, text in json.load(sys.stdin):
    context = msg_loader.MsgContext.create_default()
    msg_loader.load_msg_from_string(context, "int32 n\\n", "corner_msgs/Other")
    load = getattr(msg_loader, "load_%s_from_string" % kind)
    try:
        spec = load(context, text, "corner_msgs/Corner")
        msg_loader.load_depends(context, spec, places)
        answers.append(gentools.compute_md5(context, spec))
    except Exception:
        answers.append(None)
json.dump(answers, sys.stdout)
"""


def md5_here(kind: str, text: str) -> str | None:
    store = MessageStore()
    store.add_text("corner_msgs/Other", OTHER)
    try:
        store.add_text("corner_msgs/Corner", text, kind=kind)  # type: ignore[arg-type]
        load = store.load_msg if kind == "msg" else store.load_srv
        return load("corner_msgs/Corner")._md5sum
    except MessageError:
        return None


@pytest.mark.parametrize(
    ("kind", "text", "expected"),
    [pytest.param(kind, text, md5, id=f"{kind}-{name}") for kind, name, text, md5 in CORNERS],
)
def test_reads_what_genmsg_reads(kind: str, text: str, expected: str | None) -> None:
    assert md5_here(kind, text) == expected


@pytest.mark.interop
def test_genmsg_still_answers_the_same(system_python) -> None:
    cases = [(kind, text) for kind, _, text, _ in CORNERS]
    answers = json.loads(system_python(ASK_GENMSG, json.dumps(cases), needs="genmsg"))
    assert answers == [md5 for *_, md5 in CORNERS]


@pytest.mark.parametrize(
    ("kind", "text", "line"),
    [
        ("msg", "int32 a\n\n# c\nint32", 4),
        ("msg", "int32 a\nint32 a", 2),
        ("msg", "\n\nuint8 X=256\n", 3),
        ("srv", "int32\n---\n", 1),
        ("srv", "int32 a\n---\nint32 b\nint32", 4),
        ("srv", "int32 a\n---\nint32 b\n---\nint32", 5),
        ("action", "int32 a\n---\nint32 b\n---\n\nint32", 6),
    ],
)
def test_errors_name_the_line(kind, text: str, line: int) -> None:
    with pytest.raises(MessageSpecError) as caught:
        MessageStore().add_text("corner_msgs/Corner", text, kind=kind)
    assert (caught.value.path, caught.value.line) == ("corner_msgs/Corner", line)


def test_errors_name_the_file(tmp_path) -> None:
    path = tmp_path / "my_msgs" / "msg" / "Bad.msg"
    path.parent.mkdir(parents=True)
    path.write_text("int32 a\nint32 1b\n")
    with pytest.raises(MessageSpecError) as caught:
        MessageStore([tmp_path]).load_msg("my_msgs/Bad")
    assert (caught.value.path, caught.value.line) == (str(path), 2)
    assert str(caught.value) == f"{path}:2: '1b' is not a legal field name"
