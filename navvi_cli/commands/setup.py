"""Install the packages of Debian 12 or 13 that NavVI needs.

They are about 1.5 GB. It takes some minutes, and needs root or sudo. Every
other command does this, too, where packages are missing. Where there is no
terminal nothing is asked: sudo without a password is needed then.

Exit codes
0: everything is installed. 1: something could not be. 2: a wrong argument.
"""
from navvi_cli.say import say
from navvi_cli.workspace import shell


def run(args):
    shell("install_packages", "all")
    say("everything that NavVI needs of Debian is installed. \"./navvi run\" builds it and starts a session.")
