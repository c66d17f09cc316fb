"""The version, as records name it."""
import subprocess
from xml.etree import ElementTree

from .places import ROOT, WORKSPACE, share


def version():
    """Such as 0.1.0, or in a checkout 0.1.0+0123456789ab, -dirty where files differ from the commit."""
    number = ElementTree.parse(share("navvi") / "package.xml").findtext("version")
    if not WORKSPACE:
        return number
    described = subprocess.run(["git", "-C", str(ROOT), "describe", "--always", "--dirty", "--abbrev=12", "--exclude=*"], text=True,
                               stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    return f"{number}+{described.stdout.strip()}" if described.stdout.strip() else number
