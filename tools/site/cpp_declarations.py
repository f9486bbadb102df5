"""Reads a header of this tree: its public declarations with their comments. It knows the house's style, not all of C++."""

import dataclasses
import re
import textwrap


@dataclasses.dataclass
class Entry:
    """A declaration. Types and functions of a namespace have a name, by which they are found."""

    declaration: str
    about: str = ""
    name: str = ""
    members: list = dataclasses.field(default_factory=list)


@dataclasses.dataclass
class Scope:
    entries: list
    is_public: bool = True
    is_type: bool = False


TYPE = re.compile(r"^(?:template <.*?>\s+)?(class|struct|union)\s+(\w+)", re.DOTALL)
ACCESS = re.compile(r"(public|private|protected):")
SKIPPED = re.compile(r"(?:(?:class|struct|enum class) \w+$|friend |using namespace |static_assert|~)")
PAIRS = {"(": ")", "{": "}", "[": "]"}


def read(text):
    """The public declarations of a header, in order."""
    return Reader(text).read()


class Reader:
    def __init__(self, text):
        self.text, self.at = text, 0
        self.top = Scope([])
        self.scopes, self.comment, self.last = [self.top], [], None

    def read(self):
        while self.at < len(self.text):
            if self.text[self.at].isspace():
                self.at += 1
            elif self.text.startswith(("//", "#"), self.at):
                self.line()
            elif self.text[self.at] == "}":
                self.scopes.pop()
                self.at = self.text.index("\n", self.at)
            elif access := ACCESS.match(self.text, self.at):
                self.scopes[-1].is_public = access[1] == "public"
                self.at = access.end()
            else:
                self.declaration()
        return self.top.entries

    def line(self):
        """A comment, or what the preprocessor reads."""
        end = self.text.find("\n", self.at) % (len(self.text) + 1)
        line, self.at = self.text[self.at : end], end
        if line.startswith("///<"):
            if self.last:
                self.last.about += line[4:] + "\n"
        elif line.startswith("///"):
            self.comment.append(line[3:])

    def declaration(self):
        begin, end = self.at, self.end_of_declaration()
        head = self.text[begin:end].strip()
        about, self.comment = "\n".join(self.comment), []
        opens = self.text[end] == "{"
        self.at = end + 1
        if head.startswith("namespace") or head.startswith('extern "C"'):
            self.scopes.append(Scope(self.top.entries))
        elif opens and (type_ := TYPE.match(head)):
            entry = self.keep(Entry(head, about, type_[2]))
            self.scopes.append(Scope(entry.members, type_[1] != "class" and self.scopes[-1].is_public, True))
        else:
            if opens:
                self.at = after_pair(self.text, end)
                if head.startswith("enum"):
                    head = self.text[begin : self.at]
                self.at += self.text.startswith(";", self.at)
            if not SKIPPED.match(head) and not head.endswith(("= default", "= delete")):
                self.keep(Entry(textwrap.dedent(indented(self.text, begin) + signature(head)), about, self.name_of(head)))

    def name_of(self, head):
        if self.scopes[-1].is_type:
            return ""
        if found := re.match(r"enum (?:class )?(\w+)", head):
            return found[1]
        found = re.search(r"([\w]+|operator\S+)\s*\(", head) or re.search(r"(\w+)\s*(?:=|$)", head)
        return found[1] if found else ""

    def keep(self, entry):
        """Adds it where it is public. Its comment may follow it."""
        if self.scopes[-1].is_public:
            self.scopes[-1].entries.append(entry)
        self.last = entry
        return entry

    def end_of_declaration(self):
        """Where its semicolon is, or the brace that opens its body."""
        at = self.at
        while True:
            char = self.text[at]
            if char == ";":
                return at
            if char == "{" and not is_value(self.text[self.at : at]):
                return at
            at = after_pair(self.text, at) if char in PAIRS else after_word(self.text, at)


def is_value(head):
    """Whether a brace after this begins a value, not a body."""
    head = head.strip()
    return "(" not in head and not re.match(r"(?:template <.*?>\s+)?(class|struct|union|enum|namespace|extern)\b", head, re.DOTALL) or head.endswith("=")


def after_word(text, at):
    """The place behind one character, a string or a comment."""
    if text.startswith("//", at):
        return text.index("\n", at)
    if text[at] in "\"'":
        end = at + 1
        while text[end] != text[at]:
            end += 2 if text[end] == "\\" else 1
        return end + 1
    return at + 1


def after_pair(text, at):
    """The place behind the bracket that closes the one here."""
    closing = PAIRS[text[at]]
    at += 1
    while text[at] != closing:
        at = after_pair(text, at) if text[at] in PAIRS else after_word(text, at)
    return at + 1


def indented(text, at):
    """The spaces before a declaration."""
    return re.search(r"[ ]*$", text[:at])[0]


def signature(head):
    """A function without what initialises members."""
    return re.sub(r"(\)(?: const| noexcept)*)\s*:\s.*$", r"\1", head, flags=re.DOTALL)
