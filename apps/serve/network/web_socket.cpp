#include "connections.hpp"

#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket.hpp>

#include <algorithm>
#include <chrono>
#include <deque>

namespace elvis::serve {

namespace {

namespace beast = boost::beast;
namespace websocket = beast::websocket;
using Clock = std::chrono::steady_clock;

/** A scene with long lists is smaller. */
constexpr std::size_t most_message_bytes = std::size_t{1} << 20u;
/** Of one page; a hand sends up to 120. Who sends more waits. */
constexpr double most_messages_a_second = 300, most_messages_at_once = 600;
/** Who asks but does not read is cut off. */
constexpr std::size_t most_waiting_messages = 500;

/** Messages that may still come now. */
class Allowance {
public:
    /** Takes one; 0, or how long to wait before the next. */
    std::chrono::milliseconds take() {
        const Clock::time_point now = Clock::now();
        const double seconds = std::chrono::duration<double>(now - m_last).count();
        m_last = now;
        m_left = std::min(most_messages_at_once, m_left + seconds * most_messages_a_second) - 1;
        const double wait = m_left >= 0 ? 0 : -m_left / most_messages_a_second;
        return std::chrono::milliseconds(static_cast<int>(1000 * wait));
    }

private:
    Clock::time_point m_last = Clock::now();
    double m_left = most_messages_at_once;
};

class WebSocket : public std::enable_shared_from_this<WebSocket> {
public:
    WebSocket(Hall& hall, Counted counted, beast::tcp_stream stream, std::shared_ptr<Session> session, bool is_companion)
        : m_hall(hall), m_counted(std::move(counted)), m_session(std::move(session)), m_is_companion(is_companion),
          m_socket(std::move(stream)), m_timer(hall.io) {}
    ~WebSocket() { m_hall.sessions.detached(m_session->id(), this); }
    WebSocket(const WebSocket&) = delete;
    WebSocket& operator=(const WebSocket&) = delete;

    void start(const Request& request) {
        beast::get_lowest_layer(m_socket).expires_never();
        beast::get_lowest_layer(m_socket).socket().set_option(boost::asio::ip::tcp::no_delay(true));
        m_socket.set_option(websocket::stream_base::timeout{std::chrono::seconds(10), std::chrono::seconds(40), true});
        m_socket.read_message_max(most_message_bytes);
        m_socket.auto_fragment(false);
        m_hall.sessions.attached(m_session->id(), this, m_is_companion);
        m_socket.async_accept(request, [self = shared_from_this()](const beast::error_code& error) {
            if (!error) {
                self->accepted();
            }
        });
    }

private:
    void accepted() {
        Send send = [weak = weak_from_this(), &io = m_hall.io](Outgoing message) {
            boost::asio::post(io, [weak, message = std::move(message)]() mutable {
                if (const auto self = weak.lock()) {
                    self->send(std::move(message));
                }
            });
        };
        if (m_is_companion) {
            m_session->attach_companion(this, std::move(send));
        } else {
            m_session->attach(this, std::move(send));
        }
        read();
    }

    void read() {
        m_socket.async_read(m_buffer, [self = shared_from_this()](const beast::error_code& error, std::size_t) {
            if (!error) {
                self->take();
            }
        });
    }

    void take() {
        m_session->receive(this, beast::buffers_to_string(m_buffer.data()));
        m_buffer.consume(m_buffer.size());
        const std::chrono::milliseconds wait = m_allowance.take();
        if (wait.count() == 0) {
            read();
            return;
        }
        m_timer.expires_after(wait);
        m_timer.async_wait([self = shared_from_this()](const beast::error_code& error) {
            if (!error) {
                self->read();
            }
        });
    }

    void send(Outgoing message) {
        if (m_waiting.size() >= most_waiting_messages) {
            beast::get_lowest_layer(m_socket).close();
            return;
        }
        m_waiting.push_back(std::move(message));
        if (m_waiting.size() == 1) {
            write();
        }
    }

    void write() {
        m_socket.binary(m_waiting.front().is_binary);
        m_socket.async_write(boost::asio::buffer(m_waiting.front().bytes),
                             [self = shared_from_this()](const beast::error_code& error, std::size_t) {
                                 if (error) {
                                     return;
                                 }
                                 self->m_waiting.pop_front();
                                 if (!self->m_waiting.empty()) {
                                     self->write();
                                 }
                             });
    }

    Hall& m_hall;
    Counted m_counted;
    std::shared_ptr<Session> m_session;
    bool m_is_companion;
    websocket::stream<beast::tcp_stream> m_socket;
    boost::asio::steady_timer m_timer;
    beast::flat_buffer m_buffer;
    Allowance m_allowance;
    std::deque<Outgoing> m_waiting;
};

} // namespace

void start_web_socket(Hall& hall, Counted counted, beast::tcp_stream stream, const Request& request,
                      std::shared_ptr<Session> session, bool is_companion) {
    std::make_shared<WebSocket>(hall, std::move(counted), std::move(stream), std::move(session), is_companion)->start(request);
}

} // namespace elvis::serve
