"""The version, as records name it."""
import subprocess
from xml.etree import ElementTree

from .places import ROOT, WORKSPACE, share


def version():
    """Such as 0.1.0+0123456789ab, -dirty where files differ from the commit; 0.1.0 where git knows none."""
    number = ElementTree.parse(share("navvi") / "package.xml").findtext("version")
    if WORKSPACE:
        commit = subprocess.run(["git", "-C", str(ROOT), "describe", "--always", "--dirty", "--abbrev=12", "--exclude=*"], text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout.strip()
    else:
        commit = (ROOT / "navvi_cli" / "commit").read_text().strip()
    return f"{number}+{commit}" if commit else number
