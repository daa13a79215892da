#include "connections.hpp"
#include "page_files.hpp"
#include "token.hpp"

#include <core/base/error.hpp>

#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket/rfc6455.hpp>

#include <algorithm>
#include <chrono>
#include <optional>

namespace elvis::serve {

namespace {

namespace beast = boost::beast;
namespace http = beast::http;

/** From a connection's beginning, or an answer, to the end of the next request. */
constexpr std::chrono::seconds request_patience{10};
constexpr std::uint32_t most_header_bytes = 8192;
constexpr std::uint64_t most_body_bytes = 1024;

using Response = http::response<http::string_body>;

Response answer(const Request& request, http::status status, const std::string& type, std::string_view text) {
    Response response(status, request.version());
    response.set(http::field::server, "elvis");
    response.set(http::field::content_type, type);
    response.set(http::field::cache_control, "no-store");
    response.set("X-Content-Type-Options", "nosniff");
    response.set("Referrer-Policy", "no-referrer");
    response.set("Content-Security-Policy",
                 "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; connect-src 'self'");
    response.body() = text;
    response.keep_alive(request.keep_alive());
    response.prepare_payload();
    if (request.method() == http::verb::head) {
        response.body().clear();
    }
    return response;
}

Response refusal(const Request& request, http::status status, std::string_view text) {
    return answer(request, status, "text/plain; charset=utf-8", std::string(text) + "\n");
}

class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
public:
    HttpConnection(Hall& hall, boost::asio::ip::tcp::socket socket)
        : m_hall(hall), m_counted(hall), m_stream(std::move(socket)) {}

    void read() {
        m_parser.emplace();
        m_parser->header_limit(most_header_bytes);
        m_parser->body_limit(most_body_bytes);
        m_stream.expires_after(request_patience);
        http::async_read(m_stream, m_buffer, *m_parser,
                         [self = shared_from_this()](const beast::error_code& error, std::size_t) {
                             if (!error) {
                                 self->handle(self->m_parser->release());
                             }
                         });
    }

private:
    void handle(const Request& request) {
        const Address address = address_of({request.target().data(), request.target().size()});
        if (beast::websocket::is_upgrade(request)) {
            if (const std::optional<Response> refused = upgrade(request, address)) {
                write(*refused);
            }
            return;
        }
        if (request.method() != http::verb::get && request.method() != http::verb::head) {
            write(refusal(request, http::status::method_not_allowed, "only GET is understood"));
            return;
        }
        const std::optional<PageFile> file = page_file(address.name);
        if (!file) {
            write(refusal(request, http::status::not_found, "there is nothing here"));
        } else if (address.name.empty() && !has_token(address)) {
            write(refusal(request, http::status::forbidden,
                          "The address lacks the token. 'elvis serve' prints the whole address when it starts."));
        } else {
            write(answer(request, http::status::ok, file->type, file->text));
        }
    }

    bool has_token(const Address& address) const { return equal_in_constant_time(address.parameter("token"), m_hall.token); }

    /** Programs say no origin; pages always do, and only ours may come. */
    bool has_right_origin(const Request& request) const {
        const auto found = request.find(http::field::origin);
        if (found == request.end()) {
            return true;
        }
        const std::string origin(found->value().data(), found->value().size());
        const auto host = request[http::field::host];
        return is_origin_of(origin, {host.data(), host.size()}) ||
               std::ranges::find(m_hall.options.origins, origin) != m_hall.options.origins.end();
    }

    /** What is wrong with it; nothing if the connection is a web socket from now on. */
    std::optional<Response> upgrade(const Request& request, const Address& address) {
        if (address.name != "session") {
            return refusal(request, http::status::not_found, "there is nothing here");
        }
        if (!has_token(address)) {
            return refusal(request, http::status::forbidden, "the token is missing or wrong");
        }
        if (!has_right_origin(request)) {
            return refusal(request, http::status::forbidden, "pages of this origin may not come; --origin allows them");
        }
        std::shared_ptr<Session> session;
        try {
            session = m_hall.sessions.find_or_make(address.parameter("session"));
        } catch (const Error& error) {
            return refusal(request, http::status::service_unavailable, error.what());
        }
        start_web_socket(m_hall, std::move(m_counted), std::move(m_stream), request, std::move(session),
                         address.parameter("companion") == "1");
        return std::nullopt;
    }

    void write(Response response) {
        m_response = std::make_shared<Response>(std::move(response));
        m_stream.expires_after(request_patience);
        http::async_write(m_stream, *m_response, [self = shared_from_this()](const beast::error_code& error, std::size_t) {
            if (error || !self->m_response->keep_alive()) {
                beast::error_code ignored;
                self->m_stream.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored);
                return;
            }
            self->read();
        });
    }

    Hall& m_hall;
    Counted m_counted;
    beast::tcp_stream m_stream;
    beast::flat_buffer m_buffer;
    std::optional<http::request_parser<http::string_body>> m_parser;
    std::shared_ptr<Response> m_response;
};

} // namespace

void start_http(Hall& hall, boost::asio::ip::tcp::socket socket) {
    std::make_shared<HttpConnection>(hall, std::move(socket))->read();
}

} // namespace elvis::serve
