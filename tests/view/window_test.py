"""What people do first in the window of ElVis, done by synthetic mouse and keys on a display of its own.

usage: window_test.py ELVIS FOLDER
"""
import json
import os
import re
import shutil
import struct
import subprocess
import sys
import zipfile

from driver import Display, Failure, Window, check_programs, pixels, require

VOLUME = {"generator": 1, "mesh": "ball", "shape": "mixed", "elements": [3, 3, 3], "geometry_order": 2, "order": 4,
          "fields": ["waves", "taylor-green"], "time_steps": 4}


def run(elvis, folder, *arguments):
    done = subprocess.run([elvis] + list(arguments), cwd=folder, capture_output=True, text=True)
    require(done.returncode == 0, f"elvis {' '.join(arguments)}: {done.stderr}")
    return done.stdout


def plane_of(screen):
    return screen["scene"]["surfaces"][1]["plane"]


def says_that_there_is_no_display(elvis, folder):
    environment = {key: value for key, value in os.environ.items() if key not in ("DISPLAY", "WAYLAND_DISPLAY")}
    done = subprocess.run([elvis, "view"], cwd=folder, env=environment, capture_output=True, text=True)
    require(done.returncode == 1, f"without a display the status is {done.returncode}")
    require("there is no display" in done.stderr, f"without a display it says: {done.stderr}")


def opens_by_dialog(window):
    window.key("ctrl+o")
    window.wait_for(lambda screen: screen["dialog"] == 1, "the dialog")
    window.write(os.path.join(window.folder, "ball.h5"))
    window.key("Return")
    window.wait_for(lambda screen: screen["volume"].endswith("ball.h5"), "the volume")
    screen = window.settle()
    require(screen["items"] == ["Boundary"], f"the items are {screen['items']}")
    window.picture("opened.png")
    left, top, right, bottom = (int(x) for x in screen["places"]["view"])
    width, height, colors = pixels("opened.png", (left, top, right - left, bottom - top))
    middle = 3 * (height // 2 * width + width // 2)
    corner = 3 * ((height - 3) * width + width - 3)
    require(colors[corner:corner + 3] == b"\xff\xff\xff", "the background is not white")
    require(colors[middle:middle + 3] != b"\xff\xff\xff", "there is no ball in the middle")


def orbits(window):
    before = window.screen()["scene"]["camera"]
    stages = set()
    # Where others are at work, pictures may all come late.
    for _ in range(8):
        window.drag(window.place("view"), (160, 70), steps=25, during=lambda screen: stages.add(screen["stage"]))
        if "moving" in stages:
            break
    window.wait_for(lambda screen: screen["scene"]["camera"]["eye"] != before["eye"], "the camera to move")
    screen = window.settle()
    after = screen["scene"]["camera"]
    distance = [sum((a - b) ** 2 for a, b in zip(camera["eye"], camera["look_at"])) for camera in (before, after)]
    require(abs(distance[0] - distance[1]) < 1e-6 * distance[0], f"the distance has changed: {distance}")
    require("moving" in stages, f"no coarse picture was shown while moving, only {stages}")
    require(screen["stage"] == "exact", "at rest the picture is not exact")
    print(f"while orbiting: {screen['frames_per_second']:.1f} pictures a second; "
          f"from rest to all pixels: {screen['rest_to_full_seconds']:.2f} s, "
          f"to pixel-exact ones: {screen['rest_to_exact_seconds']:.2f} s")


def zooms_to_the_cursor(window):
    before = window.screen()["scene"]["camera"]
    window.wheel(window.place("view", 0.6, 0.4), 3)
    window.wait_for(lambda screen: screen["scene"]["camera"]["look_at"] != before["look_at"], "what is looked at to move")
    window.key("f")
    window.wait_for(lambda screen: abs(screen["scene"]["camera"]["look_at"][0] - before["look_at"][0]) < 1e-9, "all to be seen")
    window.settle()


def adds_a_cut_plane(window):
    window.click("items/add")
    window.click("add/Cut plane")
    window.wait_for(lambda screen: len(screen["items"]) == 2 and screen["items"][1].startswith("Cut plane"), "the plane")
    window.click("item/0/shown")
    window.wait_for(lambda screen: screen["scene"]["surfaces"][0].get("visible") is False, "the boundary to be hidden")
    window.settle()


def moves_it(window):
    """Returns the plane before, after it was moved, and after it was turned, too."""
    before = plane_of(window.screen())
    window.drag(window.place("handle/move"), (60, 25))
    window.wait_for(lambda screen: plane_of(screen) != before, "the plane to move")
    screen = window.settle()
    moved = plane_of(screen)
    require(before[:3] == moved[:3], f"the plane went from {before} to {moved}")
    require(screen["undo"] == "move cut plane", f"to undo is '{screen['undo']}'")
    window.drag(window.place("handle/turn"), (30, 60))
    window.wait_for(lambda screen: plane_of(screen)[:3] != moved[:3], "the plane to turn")
    return before, moved, plane_of(window.settle())


def picks(window, elvis):
    eye = window.screen()["scene"]["camera"]["eye"]
    window.key("1")  # From +x, which is nearly across the plane.
    window.wait_for(lambda screen: screen["scene"]["camera"]["eye"] != eye, "the view from +x")
    window.settle()
    window.click("view", 0.45, 0.6)
    screen = window.wait_for(lambda screen: "element" in screen["picked"], "a point")
    picked = screen["picked"]
    place = re.search(r"x = \(([^)]*)\)", picked).group(1)
    value = float(re.search(r"waves = ([^ ,]*), gradient", picked).group(1))
    drawn = float(re.search(r"value drawn there = (.*)", picked).group(1))
    answer = json.loads(run(elvis, window.folder, "probe", "ball.h5", "--point", place.replace(" ", ""), "--json"))
    exact = answer["points"][0]["fields"]["waves"][0]
    require(abs(value - exact) < 1e-6, f"picked {value}, probed {exact}")
    require(abs(drawn - exact) < 1e-3, f"drawn {drawn}, probed {exact}")
    for word in ("xi =", "order", "Jacobian", "gradient", "velocity[2]"):
        require(word in picked, f"'{word}' is not in\n{picked}")
    window.picture("picked.png")


def undoes(window, first, moved, turned):
    for key, plane in (("ctrl+z", moved), ("ctrl+z", first), ("ctrl+y", moved), ("ctrl+y", turned)):
        window.key(key)
        window.wait_for(lambda screen: plane_of(screen) == plane, f"{key} to make the plane {plane}", 30)
    require(window.settle()["redo"] == "", "there is more to be done again")


def saves(window, elvis):
    window.key("ctrl+s")
    window.wait_for(lambda screen: screen["dialog"] == 2, "the dialog")
    window.write(os.path.join(window.folder, "saved.json"))
    window.key("Return")
    window.wait_for(lambda screen: os.path.exists("saved.json"), "the scene")
    window.wait_for(lambda screen: screen["dialog"] == 0, "the dialog to close")
    window.key("ctrl+p")
    window.wait_for(lambda screen: screen["dialog"] == 3, "the dialog")
    window.write(os.path.join(window.folder, "window.png"))
    window.key("Return")
    window.wait_for(lambda screen: any("saved the picture" in message for message in screen["messages"]), "the picture")
    window.settle()
    run(elvis, window.folder, "render", "saved.json", "-o", "rendered.png")
    with open("window.png", "rb") as one, open("rendered.png", "rb") as other:
        require(one.read() == other.read(), "elvis render draws another picture than the window saves")
    # And it is the one on the screen, but for what the window draws above it: a part without marks and handles.
    screen = window.picture("saved.png")
    left, top, right, bottom = (int(x) for x in screen["places"]["view"])
    part = (0, 3 * (bottom - top) // 4, right - left, (bottom - top) // 4)
    shown = pixels("saved.png", (left + part[0], top + part[1], part[2], part[3]))
    require(shown == pixels("rendered.png", part), "the screen shows another picture than elvis render draws")


def converts(window):
    """A foreign file is converted after asking."""
    window.key("ctrl+o")
    window.wait_for(lambda screen: screen["dialog"] == 1, "the dialog")
    window.write(os.path.join(window.folder, "foreign.json"))
    window.key("Return")
    window.wait_for(lambda screen: screen["dialog"] == 4, "the offer to convert")
    window.picture("convert.png")
    window.click("dialog/do")
    screen = window.wait_for(lambda screen: screen["volume"].endswith("foreign.h5"), "the converted volume")
    require(any("residual" in message for message in screen["messages"]), f"no report: {screen['messages']}")
    window.settle()


def drops(window):
    """A file comes by the protocol that file managers speak."""
    window.xdotool("mousemove", *window.place("view"))
    program = os.path.join(os.path.dirname(os.path.abspath(__file__)), "dnd.py")
    done = subprocess.run([sys.executable, program, "ball.h5"], env=window.environment, capture_output=True, text=True)
    require(done.returncode == 0, f"the window does not take a file: {done.stderr}")
    window.wait_for(lambda screen: screen["volume"].endswith("ball.h5"), "the volume that was dropped")
    window.settle()


def time_step(screen):
    return screen["scene"]["volume"].get("time_step", 0)


def steps_through_time(window):
    window.click("time/on")
    window.wait_for(lambda screen: time_step(screen) == 1, "the next time step")
    first = window.settle()
    window.click("time/play")
    window.wait_for(lambda screen: time_step(screen) == 3, "the last time step")
    window.wait_for(lambda screen: time_step(screen) == 0, "the first one again")
    window.click("time/play")
    window.settle()
    window.xdotool("mousemove", *window.place("time/step", 0.4))
    window.click("time/step", 0.4)
    window.wait_for(lambda screen: time_step(screen) == 1, "the step that was clicked on")
    require(window.settle()["scene"]["camera"] == first["scene"]["camera"], "time has moved the camera")


def keeps_views(window):
    window.click("tab/Camera")
    kept = window.settle()["scene"]["camera"]
    window.click("camera/keep")
    window.key("1")
    window.wait_for(lambda screen: screen["scene"]["camera"] != kept, "another camera")
    window.click("camera/view0/go")
    window.wait_for(lambda screen: screen["scene"]["camera"] == kept, "the view that was kept")
    require(len(window.settle()["scene"]["views"]) == 1, "the view is not in the scene")
    window.click("tab/Scene")


def chooses_elements(window):
    window.click("items/add")
    window.click("add/Elements")
    window.wait_for(lambda screen: len(screen["items"]) == 2, "the elements")
    window.click("elements/hexahedron", 0.1)
    window.wait_for(lambda screen: screen["scene"]["surfaces"][1].get("shapes") == ["hexahedron"], "the shape")
    window.click("elements/values", 0.1)
    window.wait_for(lambda screen: "value_range" in screen["scene"]["surfaces"][1], "the condition")
    window.click("item/0/shown")
    window.settle()
    window.picture("elements.png")
    for _ in range(4):
        window.key("ctrl+z")
    window.wait_for(lambda screen: screen["items"] == ["Boundary"], "the elements to go again")
    window.settle()


def peaks_of(screen):
    return screen["scene"].get("volume_rendering", {}).get("peaks", [])


def pulls_peaks(window):
    """In the editor of transfer functions, over the histogram."""
    window.click("items/add")
    window.click("add/Volume")
    window.click("volume/add peak")
    window.wait_for(peaks_of, "a peak")
    before = peaks_of(window.settle())[0]
    window.drag(window.place("volume/curve/peak0"), (40, 20))
    window.wait_for(lambda screen: peaks_of(screen)[0]["value"] > before["value"], "the peak to move")
    moved = peaks_of(window.settle())[0]
    require(moved["density"] < before["density"] and moved["width"] == before["width"], f"{before} has become {moved}")
    window.drag(window.place("volume/curve/side0"), (15, 0))
    window.wait_for(lambda screen: peaks_of(screen)[0]["width"] > moved["width"], "the peak to get wider")
    window.settle()
    window.picture("peaks.png")
    window.key("ctrl+z")
    window.wait_for(lambda screen: peaks_of(screen) == [moved], "the width to come back")
    window.key("ctrl+z")
    window.wait_for(lambda screen: peaks_of(screen) == [before], "the place to come back")
    window.key("ctrl+z")
    window.key("ctrl+z")
    window.wait_for(lambda screen: screen["items"] == ["Boundary"], "the volume to go again")
    window.settle()


def map_of(screen):
    return screen["scene"].get("color_map", {})


def chooses_ranges(window):
    """What the editor of colours offers."""
    window.click("scene/colors/fixed", 0.1)
    data = window.wait_for(lambda screen: "range" in map_of(screen), "the field's range")["scene"]["color_map"]["range"]
    ranges = [data]
    for button in ("scene/colors/percentiles", "scene/colors/percentiles10", "scene/colors/symmetric"):
        window.click(button)
        ranges.append(window.wait_for(lambda screen: map_of(screen)["range"] != ranges[-1], f"the range of {button}")
                      ["scene"]["color_map"]["range"])
    _, outer, inner, symmetric = ranges
    require(data[0] < outer[0] < inner[0] < inner[1] < outer[1] < data[1], f"the ranges are {ranges}")
    require(symmetric[0] == -symmetric[1] == -max(abs(x) for x in data), f"symmetric is {symmetric}")
    window.click("scene/colors/logarithmic", 0.1)
    screen = window.wait_for(lambda screen: map_of(screen).get("scale") == "logarithmic", "the logarithmic scale")
    require(0 < map_of(screen)["range"][0] < map_of(screen)["range"][1], f"its range is {map_of(screen)}")
    require(not any("logarithmic" in message for message in window.settle()["messages"]), "it cannot be drawn")
    window.picture("logarithmic.png")


def array_of_doubles(path, name):
    """Of NumPy's .npz, without NumPy."""
    with zipfile.ZipFile(path) as archive:
        data = archive.read(name + ".npy")
    header, = struct.unpack("<H", data[8:10])
    return struct.unpack(f"<{(len(data) - 10 - header) // 8}d", data[10 + header:])


def probes_a_line(window, elvis):
    """The table that is copied holds the places where elements begin, as elvis sample finds them."""
    window.click("tab/Line")
    window.click("line/add")
    screen = window.wait_for(lambda screen: screen["line"], "the line's plot")
    window.click("line/x")
    window.wait_for(lambda screen: max(abs(x) for x in screen["line"]["from"][1:] + screen["line"]["to"][1:]) < 1e-9,
                    "the line along x")
    screen = window.settle()
    require(len(screen["line"]["breaks"]) > 3, f"the breaks are {screen['line']['breaks']}")
    before = screen["line"]
    window.drag(window.place("handle/line to"), (-40, 50))
    screen = window.wait_for(lambda screen: screen["line"]["to"] != before["to"], "the end to be dragged")
    window.settle()
    window.xdotool("mousemove", *window.place("line/plot", 0.5))
    screen = window.picture("line.png")
    line = screen["line"]
    require(line["from"] == before["from"], "the other end has moved, too")
    ends = [",".join(repr(x) for x in line[end]) for end in ("from", "to")]
    run(elvis, window.folder, "sample", "ball.h5", "--line", *ends, "--count", "400", "--field", "waves", "-o", "line.npz")
    exact = array_of_doubles("line.npz", "break_points")
    shown = [x for place in line["breaks"] for x in place]
    require(len(exact) == len(shown) and max(abs(a - b) for a, b in zip(exact, shown)) < 1e-12,
            "elements begin elsewhere than elvis sample says")
    window.click("line/copy")
    window.click("line/remove")
    window.wait_for(lambda screen: screen["line"] is None, "the line to go")
    return line["table"]


def title_of(screen):
    annotation = screen["scene"]["image"].get("annotation", {})
    return annotation.get("title", "") if isinstance(annotation, dict) else ""


def pasted(window):
    """The clipboard, as a text field takes it: without tabs and line ends."""
    window.click("tab/Scene")
    if "scene/title" not in window.settle()["places"]:
        window.click("scene/own title", 0.05)
    text = ""
    for _ in range(3):  # ImGui 1.86 misses keys where frames take long.
        window.click("scene/title")
        window.key("ctrl+a")
        window.key("ctrl+v")
        window.key("Return")
        text = title_of(window.settle())
        if text:
            break
    window.click("scene/own title", 0.05)
    window.wait_for(lambda screen: not title_of(screen), "the title to go again")
    return text


def finds_numbers(window, elvis):
    """Integrals and extrema are those of the commands."""
    window.click("tab/Numbers")
    window.click("numbers/find")
    screen = window.wait_for(lambda screen: screen["numbers"]["table"] and not screen["numbers"]["finding"], "the numbers")
    names, volume, boundary = (line.split("\t") for line in screen["numbers"]["table"].splitlines())
    asked = ["ball.h5", "--field", "waves", "--time-step", str(time_step(screen))]
    integral = json.loads(run(elvis, window.folder, "integrate", *asked))
    extrema = json.loads(run(elvis, window.folder, "extrema", *asked))
    surface = json.loads(run(elvis, window.folder, "integrate", *asked, "--boundary"))
    shown = dict(zip(names, volume))
    require(abs(float(shown["integral"]) - integral["value"]) <= integral["error"], f"{shown} is not {integral}")
    require(float(shown["maximum"]) == extrema["maximum"]["value"], f"{shown} is not {extrema}")
    require(abs(float(dict(zip(names, boundary))["measure"]) - surface["measure"]) <= surface["measure_error"], f"{boundary} is not {surface}")
    window.picture("numbers.png")
    window.click("numbers/copy")
    return screen["numbers"]["table"]


def edits_lines_arrows_and_what_is_shown_of_the_volume(window):
    window.click("items/add")
    window.click("add/Streamlines")
    window.wait_for(lambda screen: screen["items"][-1] == "Streamlines velocity", "the streamlines")
    window.click("streamlines/seeds")
    window.click("streamlines/seeds/evenly")
    window.wait_for(lambda screen: screen["scene"]["surfaces"][1].get("spacing", 0) > 0, "evenly spaced seeds")
    window.click("streamlines/seeds")
    window.click("streamlines/seeds/points")
    screen = window.wait_for(lambda screen: len(screen["scene"]["surfaces"][1].get("seeds", [])) == 1, "a seed")
    seed = screen["scene"]["surfaces"][1]["seeds"][0]
    window.click("item/0/shown")
    window.drag(window.place("handle/seed"), (30, -20))
    window.wait_for(lambda screen: screen["scene"]["surfaces"][1]["seeds"][0] != seed, "the seed to move")
    window.click("streamlines/pathlines", 0.05)
    window.wait_for(lambda screen: screen["scene"]["surfaces"][1]["type"] == "pathlines", "pathlines")
    window.click("items/add")
    window.click("add/Arrows")
    window.wait_for(lambda screen: screen["items"][-1] == "Arrows velocity", "the arrows")
    window.click("arrows/spacing", 0.05)
    window.wait_for(lambda screen: screen["scene"]["surfaces"][2].get("spacing", 0) > 0, "their spacing")
    window.click("tab/Scene")
    window.wheel(window.place("scene/field"), -10)
    window.click("scene/threshold")
    window.write("x < 0.9")
    window.key("Return")
    window.wait_for(lambda screen: screen["scene"].get("threshold") == "x < 0.9", "the threshold")
    window.click("scene/warp", 0.05)
    window.wait_for(lambda screen: screen["scene"].get("warp", {}).get("field") == "velocity", "the displacement")
    screen = window.settle()
    require(not any("error" in message for message in screen["messages"][-2:]), f"it says {screen['messages']}")
    window.picture("streamlines.png")
    for _ in range(10):
        window.key("ctrl+z")
    window.wait_for(lambda screen: screen["items"] == ["Boundary"] and "warp" not in screen["scene"], "all to go again")
    window.settle()


def writes(window, what, name):
    """The file of one of the things that the picture shows."""
    window.key("ctrl+e")
    window.wait_for(lambda screen: screen["dialog"] == 7, "the dialog")
    window.click("write/what")
    window.click(f"write/what/{what}")
    window.click("dialog/name")
    window.key("ctrl+a")
    window.write(os.path.join(window.folder, name))
    window.picture(f"{name}.png")
    window.key("Return")
    screen = window.wait_for(lambda screen: screen["dialog"] == 0 and any(name in message for message in screen["messages"]), name)
    require(os.path.exists(name), f"there is no {name}: {screen['messages']}")
    with open(name, "rb") as file:
        return file.read()


def writes_numbers(window, elvis):
    """Files of surfaces, lines and grids are those of the commands."""
    window.click("items/add")
    window.click("add/Streamlines")
    window.click("streamlines/seeds")
    window.click("streamlines/seeds/on a line")
    screen = window.wait_for(lambda screen: "seed_line" in screen["scene"]["surfaces"][1], "seeds on a line")
    ends = screen["scene"]["surfaces"][1]["seed_line"]
    window.drag(window.place("handle/seeds to"), (20, 30))
    screen = window.wait_for(lambda screen: screen["scene"]["surfaces"][1]["seed_line"] != ends, "the line's end to move")
    ends = [",".join(repr(x) for x in end) for end in screen["scene"]["surfaces"][1]["seed_line"]]
    asked = ["ball.h5", "--time-step", str(time_step(screen))]
    run(elvis, window.folder, "extract", *asked, "--boundary", "--values", "waves", "-o", "same.ply")
    run(elvis, window.folder, "streamlines", *asked, "--field", "velocity", "--line", *ends, "--values", "waves", "-o", "same.csv")
    run(elvis, window.folder, "sample", *asked, "--grid", "64x64x64", "--field", "waves", "-o", "same.vti")
    for what, name in (("Boundary", "mesh.ply"), ("Grid of points", "grid.vti")):
        with open("same" + name[-4:], "rb") as same:
            require(writes(window, what, name) == same.read(), f"{name} is not what the command writes")
    # Seeds may differ in their last digit.
    written = writes(window, "Streamlines velocity", "lines.csv").decode()
    with open("same.csv") as same:
        ours, theirs = ([line.split(",") for line in text.splitlines()] for text in (written, same.read()))
    require(len(ours) == len(theirs) > 20 and ours[0] == theirs[0], f"{len(ours)} and {len(theirs)} rows")
    off = max(abs(float(a) - float(b)) for one, other in zip(ours[1:], theirs[1:]) for a, b in zip(one, other))
    require(off < 1e-6, f"lines are {off} off those that the command writes")
    window.key("ctrl+z")
    window.key("ctrl+z")
    window.key("ctrl+z")
    window.wait_for(lambda screen: screen["items"] == ["Boundary"], "the streamlines to go again")
    window.settle()


def box_of(screen, name):
    left, top, right, bottom = (int(x) for x in screen["places"][name])
    return left, top, right - left, bottom - top


def shows_two_views(window):
    """Of one camera while they are linked; each with its own items."""
    window.key("ctrl+2")
    window.wait_for(lambda screen: screen["second"] and screen["second"]["stage"] == "exact", "the second view")
    screen = window.settle()
    before = screen["scene"]["camera"]
    require(screen["second"]["scene"]["camera"] == before, "the views do not begin with one camera")
    window.drag(window.place("second view"), (60, 30))
    window.wait_for(lambda screen: screen["scene"]["camera"]["eye"] != before["eye"], "the first view to follow")
    screen = window.settle()
    linked = screen["scene"]["camera"]
    require(screen["second"]["scene"]["camera"] == linked, "linked views have two cameras")
    window.picture("two.png")
    # But for the marks in their corners.
    parts = [(left + 5, top + height // 3, width - 10, height // 2)
             for left, top, width, height in (box_of(screen, "view"), box_of(screen, "second view"))]
    require(pixels("two.png", parts[0]) == pixels("two.png", parts[1]), "linked views show two pictures")
    window.key("ctrl+l")
    window.wait_for(lambda screen: not screen["second"]["linked"], "the cameras to be unlinked")
    window.drag(window.place("second view"), (-50, 20))
    window.wait_for(lambda screen: screen["second"]["scene"]["camera"] != linked, "the second view to turn")
    window.click("item/0/shown in second")
    window.wait_for(lambda screen: screen["second"]["scene"]["surfaces"][0].get("visible") is False, "the boundary to go")
    screen = window.settle()
    require(screen["scene"]["camera"] == linked, "the first view has turned, too")
    require(screen["scene"]["surfaces"][0].get("visible") is not False, "the boundary has gone from the first view, too")
    window.picture("unlinked.png")
    require(set(pixels("unlinked.png", parts[1])[2]) == {255}, "the second view still shows something")
    require(set(pixels("unlinked.png", parts[0])[2]) != {255}, "the first view shows nothing")
    window.key("ctrl+2")
    window.wait_for(lambda screen: screen["second"] is None, "one view alone")
    window.settle()


def hides_all(window, elvis):
    """What is seen then is the background, and so it is for elvis render."""
    window.click("item/0/shown")
    window.wait_for(lambda screen: screen["scene"]["surfaces"][0].get("visible") is False, "the boundary to be hidden")
    window.settle()
    window.key("ctrl+shift+s")
    window.wait_for(lambda screen: screen["dialog"] == 2, "the dialog")
    window.write(os.path.join(window.folder, "hidden.json"))
    window.key("Return")
    window.wait_for(lambda screen: os.path.exists("hidden.json") and screen["dialog"] == 0, "the scene")
    run(elvis, window.folder, "render", "hidden.json", "-o", "hidden.png")
    window.key("ctrl+p")
    window.wait_for(lambda screen: screen["dialog"] == 3, "the dialog")
    window.write(os.path.join(window.folder, "nothing.png"))
    window.key("Return")
    window.wait_for(lambda screen: any("nothing.png" in message for message in screen["messages"]), "the picture")
    with open("nothing.png", "rb") as one, open("hidden.png", "rb") as other:
        require(one.read() == other.read(), "elvis render draws another picture of nothing than the window saves")


def shows_several_volumes(window):
    """Of one scene: all of them fill the view."""
    with open("several.json", "w") as file:
        json.dump({"version": 1, "volume": {"path": "ball.h5"}, "surfaces": [{"type": "boundary"}],
                   "volumes": [{"time_step": 2, "offset": [6, 0, 0]}]}, file)
    window.key("ctrl+o")
    window.wait_for(lambda screen: screen["dialog"] == 1, "the dialog")
    window.write(os.path.join(window.folder, "several.json"))
    window.key("Return")
    window.wait_for(lambda screen: len(screen["scene"].get("volumes", [])) == 1, "the scene")
    screen = window.settle()
    require(not any("several" in message and "opened" not in message for message in screen["messages"]), f"it says {screen['messages']}")
    window.picture("several.png")
    left, top, width, height = box_of(screen, "view")
    middle = pixels("several.png", (left, top + height // 2, width, 1))[2]
    shown = [column for column in range(width) if middle[3 * column:3 * column + 3] != b"\xff\xff\xff"]
    require(shown and 0 < shown[0] < width // 4 and 3 * width // 4 < shown[-1] < width - 1, f"from {shown[0]} to {shown[-1]} of {width}")
    require(middle[3 * (width // 2):3 * (width // 2) + 3] == b"\xff\xff\xff", "there is nothing between them")


def quits(window):
    window.key("ctrl+q")
    try:
        status = window.process.wait(timeout=30)
    except subprocess.TimeoutExpired:
        raise Failure("Ctrl+Q does not close the window")
    with open(os.path.join(window.folder, "view.log")) as file:
        log = file.read()
    require(status == 0, f"it ends with status {status}: {log}")
    require("alidation" not in log, f"the validation layer says: {log}")


def main(elvis, folder):
    check_programs()
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    os.chdir(folder)
    says_that_there_is_no_display(elvis, folder)
    with open("ball.json", "w") as file:
        json.dump(VOLUME, file)
    shutil.copy("ball.json", "foreign.json")
    run(elvis, folder, "convert", "ball.json", "-o", "ball.h5")
    display = Display()
    window = None
    try:
        window = Window(elvis, display, folder, ["--size", "1024x680", "--validation"])
        opens_by_dialog(window)
        orbits(window)
        zooms_to_the_cursor(window)
        adds_a_cut_plane(window)
        planes = moves_it(window)
        picks(window, elvis)
        undoes(window, *planes)
        saves(window, elvis)
        converts(window)
        drops(window)
        steps_through_time(window)
        keeps_views(window)
        chooses_elements(window)
        pulls_peaks(window)
        chooses_ranges(window)
        without_tabs = str.maketrans("", "", "\t\n")
        for answers in (probes_a_line, finds_numbers):
            table = answers(window, elvis)
            found, wanted = pasted(window)[:60], table.translate(without_tabs)[:60]
            require(found == wanted, f"the clipboard holds '{found}' in place of '{wanted}'")
        edits_lines_arrows_and_what_is_shown_of_the_volume(window)
        writes_numbers(window, elvis)
        shows_two_views(window)
        hides_all(window, elvis)
        shows_several_volumes(window)
        quits(window)
    finally:
        if window:
            window.close()
        display.close()
    print("all of it worked")


if __name__ == "__main__":
    try:
        main(os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]))
    except Failure as failure:
        sys.exit(f"window_test: {failure}")
