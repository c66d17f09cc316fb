"""The panel in RViz, as keys reach it."""
import os
import pathlib
import subprocess
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent


def test_keys_ask_and_begin(master):
    import rospy
    from navvi_msgs.msg import TrialRequest
    from std_msgs.msg import String
    os.environ.update(master)
    rospy.init_node("panel_test", disable_signals=True)
    asked = []
    subscribers = [rospy.Subscriber("/navvi/ask", String, lambda msg: asked.append(msg.data)),
                   rospy.Subscriber("/navvi/trial_request", TrialRequest, lambda msg: asked.append(msg.request))]
    read, write = os.pipe()
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    processes = [subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x800x24", "+extension", "GLX"],
                                  pass_fds=[write], **quiet)]
    os.close(write)
    with os.fdopen(read) as pipe:
        env = dict(master, DISPLAY=":" + pipe.readline().strip(), LIBGL_ALWAYS_SOFTWARE="1")
    try:
        processes.insert(0, subprocess.Popen(["openbox"], env=env, **quiet))
        processes.insert(0, subprocess.Popen(["/usr/bin/rviz", "-d", str(ROOT / "rviz/navvi.rviz")], env=env, **quiet))
        deadline = time.monotonic() + 120
        while len(set(map(str, asked))) < 4:
            assert time.monotonic() < deadline, f"only {asked} was asked"
            time.sleep(1)
            if all(subscriber.get_num_connections() for subscriber in subscribers):
                subprocess.run(["xdotool", "key", "r", "g", "a", "F5"], env=env, check=True, timeout=20)
    finally:
        for process in processes:
            process.terminate()
            process.wait()
    assert set(map(str, asked)) == {"repeat", "goal", "around", str(TrialRequest.BEGIN)}
