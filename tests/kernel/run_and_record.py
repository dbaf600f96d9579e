#!/usr/bin/python3
"""What a person does at the machine, in place of LinuxCNC's user interface: switches it on, runs program.ngc, records it.

Writes `samples` (the text of halsampler) and `report`: "finished", or what went wrong.
"""
import subprocess
import sys
import time

import linuxcnc

command, status, errors = linuxcnc.command(), linuxcnc.stat(), linuxcnc.error_channel()


def report(text):
    with open("report", "w") as file:
        file.write(text)


def stop_at_errors():
    message = errors.poll()
    if message and message[0] in (linuxcnc.NML_ERROR, linuxcnc.OPERATOR_ERROR):
        report(message[1])
        sys.exit(1)


def wait_for(condition, what, seconds=20):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        status.poll()
        stop_at_errors()
        if condition():
            return
        time.sleep(0.01)
    report("no answer: " + what)
    sys.exit(1)


def switch(action, value):
    action(value)
    command.wait_complete(20)


class Done:
    """For a fifth of a second: on a busy computer the queue may be empty for a moment before the end."""

    since = None

    def __call__(self):
        if status.interp_state != linuxcnc.INTERP_IDLE or status.queue > 0 or not status.inpos:
            self.since = None
            return False
        self.since = self.since or time.monotonic()
        return time.monotonic() - self.since > 0.2


time.sleep(1)
switch(command.state, linuxcnc.STATE_ESTOP_RESET)
switch(command.state, linuxcnc.STATE_ON)
switch(command.mode, linuxcnc.MODE_MANUAL)
switch(command.home, -1)
wait_for(lambda: all(status.homed[: status.joints]), "homing")
switch(command.mode, linuxcnc.MODE_AUTO)
switch(command.program_open, "program.ngc")
with open("samples", "w") as samples:
    sampler = subprocess.Popen(["halsampler", "-t"], stdout=samples)
    time.sleep(0.5)
    subprocess.check_call(["halcmd", "setp", "sampler.0.enable", "1"])
    command.auto(linuxcnc.AUTO_RUN, 0)
    wait_for(lambda: status.interp_state != linuxcnc.INTERP_IDLE, "the start of the program")
    wait_for(Done(), "the end of the program", 24 * 3600)
    time.sleep(0.3)
    subprocess.check_call(["halcmd", "setp", "sampler.0.enable", "0"])
    time.sleep(1)
    sampler.terminate()
    sampler.wait()
report("finished")
