"""The ROS master of a robot on another machine, brought near to the person's nodes, which ask their master hundreds of questions one after the other.

Parameters are answered here and changed there, too. What a node registers is passed on while the node goes on; the publishers of a topic come to
it as the master sends all later changes. Everything else is asked there. A node asks a publisher for its connection once, and never again if the
question is lost: what has no connection is registered anew, by which those that lack one ask again. So is everything where the robot's side, and its
master with it, was started anew.
"""
import http.client
import queue
import threading
import time
import xmlrpc.client

import rosgraph.xmlrpc
from rosmaster.master_api import ROSMasterHandler

CHANGES = ("setParam", "deleteParam")
HERE = (*CHANGES, "getPid", "getParam", "hasParam", "getParamNames", "searchParam", "subscribeParam", "unsubscribeParam")
AT_ONCE = 64  # what is passed on at the same time
AGAIN = 1.0  # s
CONNECTED = 10.0  # s, from one look at the connections to the next
ENDS = {"registerSubscriber": "i", "registerPublisher": "o"}  # of a connection, as getBusInfo has them
LOST = (OSError, http.client.HTTPException)  # the connection
REFUSED = xmlrpc.client.Error


def ask(server, method, *words):
    """Its code, sentence and value. Raises LOST, or REFUSED, also where what it answers cannot be read."""
    try:
        code, sentence, value = getattr(server, method)(*words)
        return code, sentence, value
    except (*LOST, REFUSED):
        raise
    except Exception as problem:  # xmlrpc.client raises many for an answer that is none
        raise xmlrpc.client.ResponseError(f"cannot read the answer to {method}: {problem}") from None


class NearMaster:
    def __init__(self, uri, at=("127.0.0.1", 0)):
        """Of the master at that URI. `uri` is its own, `at` its address and port."""
        self.far, self.of_thread = uri, threading.local()
        self.own = ROSMasterHandler(num_workers=1)
        parameters = self.ask("getParam", "/navvi", "/")[2]
        self.own.setParam("/navvi", "/", parameters if isinstance(parameters, dict) else {})
        self.registered, self.lock = {}, threading.Lock()  # the words of the last call, by method, node and topic
        self.waiting = [queue.Queue() for _ in range(AT_ONCE)]
        for one in self.waiting:
            threading.Thread(target=self.pass_on, args=(one,), daemon=True).start()
        threading.Thread(target=self.keep_connected, daemon=True).start()
        server = rosgraph.xmlrpc.ThreadingXMLRPCServer(at, log_requests=0)
        server.register_multicall_functions()
        server.register_instance(self)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        self.uri = f"http://{at[0]}:{server.server_address[1]}"

    def ask(self, method, *words):
        if not hasattr(self.of_thread, "master"):
            self.of_thread.master = xmlrpc.client.ServerProxy(self.far, allow_none=True)
        return ask(self.of_thread.master, method, *words)

    def _dispatch(self, method, words):
        if method in HERE:
            if method in CHANGES:
                self.waiting[0].put((method, words))
            return getattr(self.own, method)(*words)
        if method.startswith(("register", "unregister")):
            with self.lock:
                if method in ENDS:
                    self.registered[method, *words[:2]] = words
                else:
                    self.registered.pop((method.removeprefix("un"), *words[:2]), None)
                self.put(method, words)
            return 1, "passed on", []
        return self.ask(method, *words)

    def put(self, method, words):
        self.waiting[hash(words[:2]) % AT_ONCE].put((method, words))  # in order for each node and topic

    def keep_connected(self):
        there = self.who_is_there()
        while True:
            time.sleep(CONNECTED)
            before, there = there, self.who_is_there()
            nodes = {words[3]: self.connections(words[3]) for words in list(self.registered.values())}
            with self.lock:
                for (method, _, topic), words in self.registered.items():
                    if (connected := nodes.get(words[3])) is not None and (there != before or (ENDS[method], topic) not in connected):
                        self.put(method, words)

    def who_is_there(self):
        """Process and run of the master there; in a container each may have the process of the last one."""
        return self.insist("getPid", "/navvi")[2], self.insist("getParam", "/navvi", "/run_id")[2]

    @staticmethod
    def connections(address):
        """(end, topic) of each that the node has; None if it has ended."""
        try:
            return {(one[2], one[4]) for one in ask(xmlrpc.client.ServerProxy(address), "getBusInfo", "/master")[2]}
        except (*LOST, REFUSED, LookupError, TypeError):
            return None

    def pass_on(self, waiting):
        while True:
            method, words = waiting.get()
            answer = self.insist(method, *words)
            if method == "registerSubscriber":
                self.tell(words, answer[2])
                # A change that the master sent just after this answer may have been overtaken by it.
                time.sleep(AGAIN)
                if (later := self.insist(method, *words)[2]) != answer[2]:
                    self.tell(words, later)
            waiting.task_done()

    def insist(self, method, *words):
        while True:
            try:
                return self.ask(method, *words)
            except LOST:
                del self.of_thread.master
                time.sleep(AGAIN)
            except REFUSED as refused:
                return 0, str(refused), []

    @staticmethod
    def tell(subscriber, publishers):
        _, topic, _, address = subscriber
        try:
            ask(xmlrpc.client.ServerProxy(address), "publisherUpdate", "/master", topic, publishers)
        except (*LOST, REFUSED):  # it has ended, or what the master names are no publishers
            pass

    def finish(self, seconds):
        """Waits until all that was registered and taken back is known there. Returns whether it is."""
        deadline = time.monotonic() + seconds
        while (goes_on := any(one.unfinished_tasks for one in self.waiting)) and time.monotonic() < deadline:
            time.sleep(0.1)
        return not goes_on
