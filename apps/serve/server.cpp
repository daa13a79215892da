
#include <apps/elvis/view/scene/first_scene.hpp>
#include <apps/serve/network/connections.hpp>
#include <apps/serve/network/token.hpp>
#include <apps/serve/session/memory_limit.hpp>

#include <core/base/error.hpp>

#include <boost/asio/ip/host_name.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>

#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>

namespace elvis::serve {

namespace {

namespace net = boost::asio;
namespace fs = std::filesystem;
using net::ip::tcp;

/** A scene file, or files of a volume. */
bool names_scene(const context& library, const Options& options) {
    const std::string& first = options.files.front();
    if (!fs::exists(first)) {
        throw Error(first, "there is no such file");
    }
    return options.files.size() == 1 && nlohmann::json::parse(library.describe_file(first))["kind"] == "scene";
}

using Open = std::function<data(const std::function<data(const task&)>&)>;

std::shared_ptr<const Served> open_served(const context& library, const Options& options, const Open& open) {
    library.describe_device(); // Says at the start if there is none.
    const bool is_scene = names_scene(library, options);
    const elvis::scene named =
        is_scene ? library.read_scene(options.files.front()) : library.parse_scene(view::scene_of_files(options.files).dump());
    data volume = open([&](const task& watch) { return named.open_volume(watch); });
    view::VolumeFacts facts = view::facts_of(volume, library);
    elvis::scene first =
        is_scene ? named.copy() : library.parse_scene(view::first_scene(library, volume, options.files).dump());
    view::add_further_volumes(facts, library, Scene::parse(first.text()));
    const bool is_placed = view::is_placed(Scene::parse(first.json()));
    first.complete_camera(facts.extent());
    const fs::path near_file = fs::absolute(options.files.front()).parent_path();
    const fs::path root = options.root.empty() ? near_file : fs::absolute(options.root);
    if (!fs::is_directory(root)) {
        throw Error(root.string(), "is no folder");
    }
    const std::string folder = root.lexically_normal().lexically_proximate(fs::current_path()).string();
    Scene document = Scene::parse(first.text(folder));
    ScenePaths paths(root, document);
    auto served = std::make_shared<const Served>(library, std::move(volume), std::move(facts), std::move(document), is_placed,
                                                 folder, std::move(paths), options.most_memory << 20u);
    need_memory(*served, 0);
    library.limit_memory(served->most_bytes);
    return served;
}

class Server {
public:
    Server(std::shared_ptr<const Served> served, const Options& options)
        : m_sessions(std::move(served), options.most_sessions), m_hall{m_io, m_sessions, options, random_digits(24)},
          m_acceptor(m_io), m_timer(m_io), m_signals(m_io, SIGINT, SIGTERM) {
        boost::system::error_code error;
        const net::ip::address address = net::ip::make_address(options.address, error);
        if (error) {
            throw UsageError("--address", "'" + options.address + "' is no address such as 127.0.0.1");
        }
        const tcp::endpoint endpoint(address, options.port);
        m_acceptor.open(endpoint.protocol());
        m_acceptor.set_option(net::socket_base::reuse_address(true));
        m_acceptor.bind(endpoint, error);
        if (error) {
            throw Error(options.address + ":" + std::to_string(options.port), error.message() + "; --port chooses another one");
        }
        m_acceptor.listen(net::socket_base::max_listen_connections);
    }

    std::string url() const {
        const tcp::endpoint endpoint = m_acceptor.local_endpoint();
        const net::ip::address address = endpoint.address();
        const std::string host = address.is_unspecified() ? net::ip::host_name()
                                 : address.is_v6()        ? "[" + address.to_string() + "]"
                                                          : address.to_string();
        return "http://" + host + ":" + std::to_string(endpoint.port()) + "/?token=" + m_hall.token;
    }

    void run() {
        m_signals.async_wait([this](const boost::system::error_code& error, int) {
            if (!error) {
                m_io.stop();
            }
        });
        if (m_hall.options.ends_with_input) {
            m_input.assign(::dup(STDIN_FILENO));
            wait_for_end_of_input();
        }
        accept();
        tidy();
        m_io.run();
        m_sessions.stop_all();
    }

private:
    void wait_for_end_of_input() {
        m_input.async_read_some(net::buffer(m_read), [this](const boost::system::error_code& error, std::size_t) {
            if (error) {
                m_io.stop();
            } else {
                wait_for_end_of_input();
            }
        });
    }

    void accept() {
        m_acceptor.async_accept([this](const boost::system::error_code& error, tcp::socket socket) {
            if (!error && m_hall.n_connections < m_hall.options.most_connections) {
                start_http(m_hall, std::move(socket));
            } else if (error) {
                // Without files to open: later.
                m_pause.expires_after(std::chrono::milliseconds(100));
                m_pause.async_wait([this](const boost::system::error_code&) { accept(); });
                return;
            }
            accept();
        });
    }

    void tidy() {
        m_timer.expires_after(std::chrono::seconds(2));
        m_timer.async_wait([this](const boost::system::error_code& error) {
            if (!error) {
                m_sessions.end_old();
                m_sessions.make_room();
                tidy();
            }
        });
    }

    /** Before the context, whose connections speak to them when they end. */
    Sessions m_sessions;
    Hall m_hall;
    net::io_context m_io{1};
    tcp::acceptor m_acceptor;
    net::steady_timer m_timer, m_pause{m_io};
    net::signal_set m_signals;
    net::posix::stream_descriptor m_input{m_io};
    std::array<char, 64> m_read{};
};

} // namespace

void run(const context& library, const Options& options, const Open& open,
         const std::function<void(const std::string&)>& on_url) {
    Server server(open_served(library, options, open), options);
    on_url(server.url());
    server.run();
}

} // namespace elvis::serve
