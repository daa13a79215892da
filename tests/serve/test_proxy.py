"""`elvis serve` behind others: nginx with a prefix, which it leaves in requests or takes away, and a port that is forwarded as by ssh -L."""
import os
import shutil
import socket
import subprocess
import tempfile
import threading
import time
import unittest
import urllib.request

from browser import free_port
from serving import Page, Server
from test_serve import make_volume
from web_socket import Refused, WebSocket

NGINX = shutil.which("nginx") or shutil.which("nginx", path="/usr/sbin")
CONFIGURATION = """
daemon off; master_process off; pid {folder}/nginx.pid; error_log stderr error;
events {{}}
http {{
    access_log off; client_body_temp_path {folder}/body; proxy_temp_path {folder}/proxy; fastcgi_temp_path {folder}/f;
    uwsgi_temp_path {folder}/u; scgi_temp_path {folder}/s;
    proxy_http_version 1.1; proxy_set_header Host $http_host; proxy_set_header Upgrade $http_upgrade; proxy_set_header Connection "upgrade";
    server {{
        listen 127.0.0.1:{port};
        location /taken/away/ {{ proxy_pass http://127.0.0.1:{server}/; }}
        location /left/ {{ proxy_pass http://127.0.0.1:{server}; }}
    }}
}}
"""


@unittest.skipUnless(NGINX, "nginx not installed: the page is not tested behind a proxy")
class ProxyTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="elvis-proxy-test-")
        self.addCleanup(folder.cleanup)
        self.server = Server(make_volume(folder.name))
        self.addCleanup(lambda: self.assertEqual(self.server.stop(), 0))
        self.port = free_port()
        path = os.path.join(folder.name, "nginx.conf")
        with open(path, "w") as file:
            file.write(CONFIGURATION.format(folder=folder.name, port=self.port, server=self.server.port))
        self.nginx = subprocess.Popen([NGINX, "-p", folder.name, "-c", path])
        self.addCleanup(self.end_nginx)

    def end_nginx(self):
        self.nginx.terminate()
        self.nginx.wait(20)

    def get(self, path):
        for _ in range(100):
            try:
                with urllib.request.urlopen(f"http://127.0.0.1:{self.port}{path}", timeout=30) as answer:
                    return answer.read()
            except ConnectionError:
                time.sleep(0.1)
            except urllib.error.URLError:
                time.sleep(0.1)
        raise AssertionError(f"{path} cannot be had")

    def test_any_prefix_works(self):
        for prefix in ("/taken/away/", "/left/"):
            self.assertIn(b"<!doctype html>", self.get(f"{prefix}?token={self.server.token}"))
            self.assertIn(b"import", self.get(f"{prefix}main.js"))
            target = f"{prefix}session?token={self.server.token}"
            page = Page(WebSocket(self.port, target, [f"Origin: http://127.0.0.1:{self.port}"]), [80, 60])
            self.assertTrue(page.exact()["bytes"].startswith(b"\x89PNG"))
            page.close()
            with self.assertRaises(Refused):
                WebSocket(self.port, target, ["Origin: http://elsewhere.example"])


class Forward:
    """A port whose bytes go to another one, unread."""

    def __init__(self, port):
        self.to = port
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.port = self.listener.getsockname()[1]
        threading.Thread(target=self.accept, daemon=True).start()

    def accept(self):
        while True:
            try:
                near, _ = self.listener.accept()
            except OSError:
                return
            threading.Thread(target=self.carry, args=(near,), daemon=True).start()

    def carry(self, near):
        with near, socket.create_connection(("127.0.0.1", self.to)) as far:
            back = threading.Thread(target=self.copy, args=(far, near), daemon=True)
            back.start()
            self.copy(near, far)
            back.join()

    @staticmethod
    def copy(one, other):
        try:
            while data := one.recv(65536):
                other.sendall(data)
            other.shutdown(socket.SHUT_WR)
        except OSError:
            pass

    def close(self):
        self.listener.close()


class ForwardTest(unittest.TestCase):
    """Browsers name the port that they see, not that of the server."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="elvis-forward-test-")
        self.addCleanup(folder.cleanup)
        self.server = Server(make_volume(folder.name), "--origin", "https://hub.example")
        self.addCleanup(lambda: self.assertEqual(self.server.stop(), 0))
        self.forward = Forward(self.server.port)
        self.addCleanup(self.forward.close)

    def socket(self, origin, host=None):
        headers = [f"Origin: {origin}"] if origin else []
        return WebSocket(self.forward.port, f"/session?token={self.server.token}&session=", headers, host)

    def test_a_page_comes_through_a_forwarded_port(self):
        with urllib.request.urlopen(f"http://127.0.0.1:{self.forward.port}/?token={self.server.token}", timeout=30) as answer:
            self.assertIn(b"<!doctype html>", answer.read())
        page = Page(self.socket(f"http://127.0.0.1:{self.forward.port}"), [80, 60])
        page.tell(type="orbit", dx=5, dy=0)
        self.assertTrue(page.exact()["bytes"].startswith(b"\x89PNG"))
        page.close()

    def test_origins_are_those_of_the_port_that_the_browser_sees(self):
        near = f"localhost:{self.forward.port}"
        for origin, host in ((f"http://{near}", near), ("https://hub.example", None), ("https://hub.example", near), (None, None)):
            self.socket(origin, host).close()
        for origin, host in ((f"http://127.0.0.1:{self.server.port}", None), (f"http://{near}", None), ("https://hub.example:444", None),
                             ("http://hub.example", None), ("https://hub.example.evil.example", None), ("null", near), ("file://", near),
                             (f"http://{near}.evil.example", near), ("http://localhost", near)):
            with self.assertRaises(Refused, msg=f"{origin} at {host}") as refused:
                self.socket(origin, host)
            self.assertEqual(refused.exception.status, 403)


if __name__ == "__main__":
    unittest.main()
