"""The robot's master, near to the person's nodes: a real one, and what a node tells it and hears of it."""
import contextlib
import os
import threading
import time
from xmlrpc.client import Fault, ServerProxy
from xmlrpc.server import SimpleXMLRPCServer

import pytest

from conftest import free_port
from sessions import Programs, eventually
from navvi_cli import near_master, network
from navvi_cli.near_master import NearMaster
from navvi_cli.say import Failure


@pytest.fixture
def masters(master):
    """That of the robot, the near one, and what is asked of it."""
    far = ServerProxy(master["ROS_MASTER_URI"])
    far.setParam("/robot", "/a/b", 1)
    near = NearMaster(master["ROS_MASTER_URI"])
    return far, near, ServerProxy(near.uri)


def test_parameters_are_known_here_and_changed_there_in_order(masters):
    far, near, own = masters
    assert own.getParam("/node", "/a/b")[2] == 1 and own.hasParam("/node", "/none")[2] is False
    for value in range(50):
        own.setParam("/node", "/c", {"d": value})
    own.setParam("/node", "/e", 3)
    own.deleteParam("/node", "/e")
    assert own.getParam("/node", "/c/d")[2] == 49
    assert near.finish(20.0)
    assert far.getParam("/node", "/c/d")[2] == 49 and far.hasParam("/node", "/e")[2] is False


@pytest.fixture
def node():
    """A node's own server: its address, what it heard of publishers, and the connections that it says it has."""
    heard, connections = [], []
    server = SimpleXMLRPCServer(("127.0.0.1", 0), logRequests=False)
    server.register_function(lambda _, topic, publishers: heard.append((topic, publishers)) or (1, "", 0), "publisherUpdate")
    server.register_function(lambda _: (1, "", connections), "getBusInfo")
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_address[1]}/", heard, connections
    server.shutdown()


def test_a_subscriber_hears_of_its_publishers_and_is_taken_back(masters, node):
    far, near, own = masters
    uri, heard, _ = node
    far.registerPublisher("/talker", "/chat", "std_msgs/String", "http://127.0.0.1:1/")
    assert own.registerSubscriber("/listener", "/chat", "std_msgs/String", uri)[0] == 1
    assert eventually(lambda: ("/chat", ["http://127.0.0.1:1/"]) in heard, 10)
    far.registerPublisher("/other", "/chat", "std_msgs/String", "http://127.0.0.1:2/")
    assert eventually(lambda: heard[-1][1] == ["http://127.0.0.1:1/", "http://127.0.0.1:2/"], 10)
    assert ["/chat", ["/listener"]] in far.getSystemState("/test")[2][1]
    own.unregisterSubscriber("/listener", "/chat", uri)
    assert near.finish(20.0) and far.getSystemState("/test")[2][1] == []
    assert own.lookupNode("/test", "/talker")[2] == "http://127.0.0.1:1/"
    assert own.registerSubscriber("/listener", "/chat", "std_msgs/String", "no address")[0] == 1, "refused there, which ends nothing here"
    assert near.finish(20.0)


def test_a_subscriber_without_a_connection_hears_of_its_publisher_again_until_it_has_one(masters, node, monkeypatch):
    monkeypatch.setattr(near_master, "CONNECTED", 0.5)
    monkeypatch.setattr(near_master, "AGAIN", 0.1)
    far, _, own = masters
    uri, heard, connections = node
    own.registerSubscriber("/listener", "/lost", "std_msgs/String", uri)
    far.registerPublisher("/talker", "/lost", "std_msgs/String", "http://127.0.0.1:1/")
    assert eventually(lambda: len(heard) > 3, 30)
    connections.append([1, "http://127.0.0.1:1/", "i", "TCPROS", "/lost", 1])
    time.sleep(2.0)
    told = len(heard)
    time.sleep(2.0)
    assert len(heard) == told
    connections.clear()
    own.unregisterSubscriber("/listener", "/lost", uri)
    time.sleep(2.0)
    assert ["/lost", ["/listener"]] not in far.getSystemState("/test")[2][1], "what was taken back stays so"


def test_a_master_that_was_started_anew_knows_what_is_registered_here(node, monkeypatch):
    monkeypatch.setattr(near_master, "CONNECTED", 0.5)
    monkeypatch.setattr(near_master, "AGAIN", 0.1)
    uri, _, connections = node
    connections.append([1, "http://127.0.0.1:1/", "i", "TCPROS", "/chat", 1])  # with nothing to show that it is lost
    port = free_port()
    at = f"http://127.0.0.1:{port}"

    def knows(*subscribers):
        with contextlib.suppress(*near_master.LOST):
            return ServerProxy(at).getSystemState("/test")[2][1] == [*subscribers]

    with Programs(dict(os.environ, ROS_MASTER_URI=at, ROS_IP="127.0.0.1")) as programs:
        first = programs.start("rosmaster", "--core", "-p", port)
        assert eventually(knows, 20)
        own = ServerProxy(NearMaster(at).uri)
        own.registerSubscriber("/listener", "/chat", "std_msgs/String", uri)
        assert eventually(lambda: knows(["/chat", ["/listener"]]), 20)
        time.sleep(1.0)
        first.terminate()
        first.wait(20)
        programs.start("rosmaster", "--core", "-p", port)
        assert eventually(lambda: knows(["/chat", ["/listener"]]), 30)


def test_a_master_and_a_node_that_answer_nonsense_end_nothing(monkeypatch, node):
    monkeypatch.setattr(near_master, "CONNECTED", 0.1)
    monkeypatch.setattr(near_master, "AGAIN", 0.1)
    uri, _, connections = node
    connections.append(1)
    nonsense = SimpleXMLRPCServer(("127.0.0.1", 0), logRequests=False, allow_none=True)
    answers = iter([[1, "", 5]])
    nonsense.register_instance(type("Nonsense", (), {"_dispatch": lambda *_: next(answers, None)})())
    threading.Thread(target=nonsense.serve_forever, daemon=True).start()
    near = NearMaster(f"http://127.0.0.1:{nonsense.server_address[1]}")
    own = ServerProxy(near.uri)
    for round_ in range(3):
        assert own.registerSubscriber("/listener", "/chat", "std_msgs/String", uri)[0] == 1
        assert eventually(lambda: near.finish(0.1), 10), round_
    with pytest.raises(Fault, match="cannot read the answer to lookupNode"):
        own.lookupNode("/test", "/talker")
    nonsense.shutdown()


@pytest.fixture
def robot(master, monkeypatch, tmp_path):
    """A master that knows a robot's side, what begins a session of it, and what registers another node there."""
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    for name in "ROS_MASTER_URI", "ROS_IP":  # which are set back afterwards
        monkeypatch.setenv(name, "")
    far, known = ServerProxy(master["ROS_MASTER_URI"]), []

    def register(name, uri, topic="/navvi/order", call="registerSubscriber"):
        getattr(far, call)(name, topic, "*", uri)
        known.append((name, topic, uri, call))
    register("/sim_node", "http://127.0.0.1:1/")
    yield lambda: network.FarNetwork(master["ROS_MASTER_URI"].removeprefix("http://")), register
    for name, topic, uri, call in known:
        getattr(far, f"un{call}")(name, topic, uri)


def test_names_that_a_cut_connection_left_behind_keep_nobody_out_and_a_person_who_drives_does(robot, node):
    begin, register = robot
    register("/feedback_node", "http://127.0.0.1:1/")
    register("/trial_node", "http://127.0.0.1:1/")
    begin()
    register("/trial_node", node[0])
    with pytest.raises(Failure, match="somebody drives this robot already: /trial_node run;.*rosnode cleanup"):
        begin()


def test_whether_the_robot_tells_of_contacts_is_known(robot):
    begin, register = robot
    assert not begin().tells_contacts
    register("/perception_node", "http://127.0.0.1:1/", "/navvi/contacts", "registerPublisher")
    assert begin().tells_contacts


def test_a_session_of_a_robot_elsewhere_is_found_by_who_watches_it(robot):
    session = robot[0]()
    assert network.running_sessions() == [session.port]
    assert ServerProxy(f"http://{network.address_of(session.port)}:{session.port}").lookupNode("/test", "/sim_node")[2] == "http://127.0.0.1:1/"
