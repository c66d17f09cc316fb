"""The version, as records name it."""
import shutil
import subprocess
from xml.etree import ElementTree

from .places import ROOT, WORKSPACE, share


def version():
    """Such as 0.1.0+0123456789ab, -dirty where files differ from the commit; 0.1.0 where git knows none."""
    number = ElementTree.parse(share("navvi") / "package.xml").findtext("version")
    commit = described() if WORKSPACE else (ROOT / "navvi_cli" / "commit").read_text().strip()
    return f"{number}+{commit}" if commit else number


def described():
    """The commit of the sources; empty where there is no git, or it knows none."""
    if not shutil.which("git"):
        return ""
    return subprocess.run(["git", "-C", str(ROOT), "describe", "--always", "--dirty", "--abbrev=12", "--exclude=*"], text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout.strip()
