"""`elvis serve` behind nginx: below a prefix, which the proxy leaves in requests or takes away."""
import os
import shutil
import subprocess
import tempfile
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


if __name__ == "__main__":
    unittest.main()
