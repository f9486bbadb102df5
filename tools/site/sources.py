"""Links of pages, in the tree and in the site, and pages that show files of the tree."""

import re
import posixpath

LINK = re.compile(r"(\]\()([^)\s#]+)((?:#[^)\s]*)?\))")
LANGUAGES = {".hpp": "cpp", ".cpp": "cpp", ".py": "python", ".yaml": "yaml", ".urdf": "xml", ".cmake": "cmake", ".toml": "toml", ".json": "json",
             ".sh": "sh", ".csv": "text", ".txt": "text", ".ts": "typescript"}  # fmt: skip


class Pages:
    """Where each page of the tree stands in the site, and which files of the tree they link to."""

    def __init__(self, root, site_of):
        self.root, self.site_of = root, site_of
        self.tree_of = {site: tree for tree, site in site_of.items()}
        self.shown = {}

    def linked(self, text, site):
        """The text of a page with its links as they are in the site."""
        folder = posixpath.dirname(self.tree_of[site])

        def to_site(found):
            opening, target, rest = found.groups()
            if "://" in target or target.startswith("mailto:"):
                return found[0]
            path = posixpath.normpath(posixpath.join(folder, target))
            return opening + posixpath.relpath(self.place(path), posixpath.dirname(site) or ".") + rest

        return LINK.sub(to_site, text)

    def place(self, path):
        """Where the site has this path of the tree."""
        if path in self.site_of:
            return self.site_of[path]
        if f"{path}/README.md" in self.site_of:
            return self.site_of[f"{path}/README.md"]
        if path.startswith("docs/"):
            return path.removeprefix("docs/")
        if not (self.root / path).exists():
            return path  # MkDocs says that it is missing
        self.shown[path] = f"files/{path.replace('.', '_')}.md" if (self.root / path).is_file() else f"files/{path}/index.md"
        return self.shown[path]

    def linked_files(self):
        """A page for each file and folder that pages linked to, and for each file of such a folder."""
        for folder in [path for path in self.shown if (self.root / path).is_dir()]:
            for file in sorted((self.root / folder).iterdir()):
                if file.is_file() and file.suffix in LANGUAGES:
                    self.place(f"{folder}/{file.name}")
        return {site: self.shows(path, site) for path, site in self.shown.items()}

    def shows(self, path, site):
        if (self.root / path).is_dir():
            inside = [other for other in sorted(self.shown) if posixpath.dirname(other) == path]
            return "\n".join([f"# {path}/", "", *(f"- [{name.rpartition('/')[2]}]({posixpath.relpath(self.shown[name], posixpath.dirname(site))})" for name in inside)])
        text = (self.root / path).read_text()
        fence = "`" * (3 + max(map(len, re.findall("`+", text)), default=0))
        language = LANGUAGES.get(posixpath.splitext(path)[1], "text")
        return f"# {path.rpartition('/')[2]}\n\n`{path}`\n\n{fence}{language}\n{text}\n{fence}\n"
