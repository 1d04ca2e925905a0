#include <doctest/doctest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <future>
#include <set>
#include <string>
#include <vector>

#include "batch/csv.h"
#include "batch/gpu_process.h"
#include "batch/gpu_wire.h"
#include "batch/item_key.h"
#include "batch/journal.h"
#include "batch/machine.h"
#include "batch/manifest.h"
#include "batch/output_template.h"
#include "batch/page.h"
#include "batch/plan.h"
#include "batch/progress_line.h"
#include "batch/request.h"
#include "batch/run.h"
#include "batch/shared_gpu.h"
#include "batch/stale_files.h"
#include "batch/tally.h"
#include "batch/worker_pool.h"
#include "support/shapes.h"
#include "zskel/core/error.h"
#include "zskel/io/output_file.h"

using namespace zskel;
using namespace zskel::batch;
namespace fs = std::filesystem;

namespace {

struct Folder {
    fs::path path = fs::temp_directory_path() / ("zskel_batch_test_" + std::to_string(::getpid()));
    Folder() { fs::create_directories(path); }
    ~Folder() { fs::remove_all(path); }
    std::string at(const std::string& name) const { return (path / name).string(); }
    void put(const std::string& name, const std::string& text) const {
        fs::create_directories((path / name).parent_path());
        std::ofstream(path / name, std::ios::binary) << text;
    }
};

Record made(const std::string& output, Status status, const std::string& key = "k") {
    Record record;
    record.model = "m.obj";
    record.output = output;
    record.status = status;
    record.key = key;
    if (status == Status::Failed) record.reason = "bad_input";
    return record;
}

std::vector<std::string> models_of(const std::vector<Entry>& entries) {
    std::vector<std::string> models;
    for (const Entry& entry : entries) models.push_back(entry.model);
    return models;
}

// Stands in for a worker: what it does, a model's name says.
[[noreturn]] void play_worker(int socket) {
    std::string bytes;
    char piece[4096];
    int done = 0;
    for (ssize_t count; (count = ::recv(socket, piece, sizeof piece, 0)) > 0;) {
        bytes.append(piece, static_cast<std::size_t>(count));
        while (const auto request = take_request(bytes)) {
            Record record;
            record.key = "k";
            record.backend = "none";
            std::string answer = begun_line(record);
            ::send(socket, answer.data(), answer.size(), 0);
            std::signal(SIGABRT, SIG_DFL);  // doctest would tell of it
            if (request->model == "crash") std::raise(SIGABRT);
            if (request->model == "kill") std::raise(SIGKILL);
            if (request->model == "leave") ::_exit(9);
            while (request->model == "hang") ::pause();
            if (request->model == "fresh" && done > 0) {
                record.status = Status::Failed;
                record.reason = "memory";
            } else {
                record.status = Status::Ok;
            }
            ++done;
            answer = to_line(record) + "\n";
            ::send(socket, answer.data(), answer.size(), 0);
        }
    }
    ::_exit(0);
}

Record result_of(WorkerPool& pool, const std::string& model) {
    pool.give({model, model + ".json", std::nullopt, false});
    std::vector<Record> records;
    while (records.empty()) records = pool.wait(std::chrono::milliseconds(10000), -1);
    REQUIRE(records.size() == 1);
    return records.front();
}

}  // namespace

TEST_CASE("parse_csv: quotes, line breaks in them, and both ends of lines") {
    const auto rows = parse_csv("a,b\r\n\"x, \"\"y\"\"\",\"1\n2\"\n\nlast,\n", "t");
    REQUIRE(rows.size() == 3);
    CHECK(rows[1] == std::vector<std::string>{"x, \"y\"", "1\n2"});
    CHECK(rows[2] == std::vector<std::string>{"last", ""});
    CHECK(parse_csv("", "t").empty());
}

TEST_CASE("parse_csv: a quote out of place is an error that names its line") {
    CHECK_THROWS_WITH_AS(parse_csv("a\n\"b\n", "t"), doctest::Contains("t: line 2"), InputError);
    CHECK_THROWS_WITH_AS(parse_csv("a\"b\n", "t"), doctest::Contains("t: line 1"), InputError);
}

TEST_CASE("manifest: lists, CSV and JSON lines give their models in order") {
    CHECK(models_of(entries_of_list("a.obj\r\n# b.obj\n\nc d.obj")) ==
          std::vector<std::string>{"a.obj", "c d.obj"});
    const auto rows = entries_of_csv("id,model,output\n7,a.obj,o.json\n8,b.obj,\n", "t");
    REQUIRE(rows.size() == 2);
    CHECK(rows[0].output == "o.json");
    CHECK(rows[1].output.empty());
    CHECK(rows[1].fields.at("id") == "8");
    const auto lines = entries_of_json_lines("{\"model\": \"a.obj\", \"id\": 3}\n", "t");
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].fields.at("id") == "3");
}

TEST_CASE("manifest: what is malformed names its line") {
    CHECK_THROWS_WITH_AS(entries_of_csv("id\n1\n", "t"), doctest::Contains("model"), InputError);
    CHECK_THROWS_WITH_AS(entries_of_csv("model,id\na\n", "t"), doctest::Contains("row 2"),
                         InputError);
    CHECK_THROWS_WITH_AS(entries_of_csv("model\n\"\"\n", "t"), doctest::Contains("row 2"),
                         InputError);
    const std::string deep(300000, '[');  // more than a stack would hold
    for (const std::string& line : {std::string("x"), std::string("[1]"), std::string("{}"),
                                    std::string("{\"model\": {}}"), "{\"model\": " + deep}) {
        CHECK_THROWS_WITH_AS(entries_of_json_lines("\n" + line + "\n", "t"),
                             doctest::Contains("t: line 2"), InputError);
    }
}

TEST_CASE("manifest: a folder's models by name, without skeletons and what lies deeper") {
    const Folder folder;
    for (const char* name : {"b.OBJ", "a.stl", "a.json", "s.surface.json", "x.txt", "deep/c.ply"})
        folder.put(name, "");
    CHECK(models_of(read_manifest(folder.path.string(), false)) ==
          std::vector<std::string>{folder.at("a.stl"), folder.at("b.OBJ"),
                                   folder.at("s.surface.json")});
    CHECK(read_manifest(folder.path.string(), true).size() == 4);
    CHECK_THROWS_AS(read_manifest(folder.at("none.txt"), false), InputError);
    CHECK(models_of(read_manifest("single.obj", false)) == std::vector<std::string>{"single.obj"});
}

TEST_CASE("fill_template: every name, columns, and doubled braces") {
    const Entry entry{"in/a.b.obj", "", {{"group", "g"}}};
    CHECK(fill_template("{dir}/{stem}|{name}|{index}|{group}|{{x}}", entry, 12) ==
          "in/a.b|a.b.obj|12|g|{x}");
    CHECK(fill_template("{dir}/{stem}", {"s.surface.json", "", {}}, 0) == "./s");
    CHECK_THROWS_WITH_AS(fill_template("{grup}", entry, 0), doctest::Contains("group"), UsageError);
    CHECK_THROWS_AS(fill_template("a{stem", entry, 0), UsageError);
}

TEST_CASE("plan_items: outputs that would meet are refused before any work") {
    const std::vector<Entry> entries{{"a/x.obj", "", {}}, {"b/x.obj", "", {}}};
    CHECK(plan_items(entries, "{dir}/{stem}.json")[1].output == "b/x.json");
    const Folder folder;
    fs::create_directory_symlink(".", folder.at("self"));
    const auto refused = [](const std::vector<Entry>& of, const std::string& pattern,
                            const BatchFiles& files, const char* why) {
        CHECK_THROWS_WITH_AS(check_files(plan_items(of, pattern), files), doctest::Contains(why),
                             UsageError);
    };
    refused(entries, "{stem}.json", {}, "{dir}");
    refused({{"a.obj", "x.json", {}}, {"b.obj", "./q/../x.json", {}}}, "", {}, "two models");
    refused({{"a.obj", "b.obj", {}}, {"./b.obj", "c.obj", {}}}, "", {}, "replace this model");
    refused({{folder.at("a.obj"), folder.at("self/a.obj"), {}}}, "", {}, "replace this model");
    refused({{"a.obj", "b.json", {}}}, "", {{"a.txt"}, "b.jsonl", "./a.txt"}, "a manifest");
    refused({{"a.obj", "b.json", {}}}, "", {{"a.txt"}, "b.jsonl", "a.obj"}, "the report");
    refused({{"a.obj", "b.json", {}}}, "", {{"a.txt"}, "b.json", ""}, "the journal");
    refused({{"a.obj", "a.txt", {}}}, "", {{"a.txt"}, "b.jsonl", ""}, "a manifest");
    refused({{"a.obj", "b.json", {}}}, "", {{"a.txt"}, "b.jsonl", "b.jsonl"}, "the journal");
    CHECK_NOTHROW(
        check_files(plan_items({{"a.obj", "b.json", {}}}, ""), {{"a.obj"}, "b.jsonl", "b.html"}));
    CHECK_THROWS_AS(plan_items({{"-", "x.json", {}}}, ""), UsageError);
    CHECK_THROWS_AS(plan_items({{std::string("a\0b", 3), "x.json", {}}}, ""), UsageError);
}

TEST_CASE("items_of_shard: the parts are the whole, each item once") {
    std::vector<Item> items;
    for (std::size_t i = 0; i < 23; ++i) items.push_back({i, "m", "o"});
    for (const std::size_t count : {1, 2, 5, 23, 40}) {
        std::multiset<std::size_t> seen;
        for (std::size_t number = 1; number <= count; ++number) {
            const auto part = items_of_shard(items, {number, count});
            CHECK(part.size() <= items.size() / count + 1);
            for (const Item& item : part) seen.insert(item.index);
        }
        CHECK(seen.size() == items.size());
        CHECK(std::set<std::size_t>(seen.begin(), seen.end()).size() == items.size());
    }
    CHECK(parse_shard("2/8").number == 2);
    for (const char* bad : {"0/2", "3/2", "1", "1/", "/2", "a/b", "1/2x", "-1/2", ""})
        CHECK_THROWS_AS(parse_shard(bad), UsageError);
}

TEST_CASE("request: any name travels unchanged, in pieces too") {
    const Request request{"a\n\xff", "o \"x\"", Request::Known{"key", true}, true, true};
    const std::string message = to_message(request) + to_message({"b", "c", std::nullopt, false});
    std::string bytes;
    std::vector<Request> found;
    for (const char c : message) {
        bytes += c;
        while (auto taken = take_request(bytes)) found.push_back(*taken);
    }
    REQUIRE(found.size() == 2);
    CHECK(found[0].model == request.model);
    CHECK(found[0].output == request.output);
    CHECK(found[0].known->key == "key");
    CHECK(found[0].known->has_failed);
    CHECK(found[0].wants_thumbnail);
    CHECK(found[0].is_alone);
    CHECK(!found[1].known);
    CHECK(!found[1].is_alone);
    CHECK(bytes.empty());
}

TEST_CASE("gpu wire: what a backend says of itself travels unchanged") {
    BackendInfo info;
    info.name = "egl-hardware";
    info.renderer = "a GPU; \"x\"";
    info.failed = {{"device 0", "lost\n"}, {"device 1", ""}};
    const BackendInfo back = backend_info_of(to_text(info));
    CHECK(back.name == info.name);
    CHECK(back.vendor.empty());
    CHECK(back.renderer == info.renderer);
    REQUIRE(back.failed.size() == 2);
    CHECK(back.failed[0].reason == "lost\n");
    CHECK(back.failed[1].candidate == "device 1");
}

TEST_CASE("GpuProcess: another takes the place of one that has ended, at the same address") {
    // Stands in for the server: takes one connection, answers an Open and ends.
    GpuProcess gpu([](int listening) {
        const int socket = ::accept(listening, nullptr, nullptr);
        Head head;
        receive_exactly(socket, std::as_writable_bytes(std::span(&head, 1)));
        BackendInfo info;
        info.name = "stand-in";
        const std::string text = to_text(info);
        send_message(socket, head.what, 0, {std::as_bytes(std::span(text))});
        ::_exit(0);
    });
    const PreparedSurface ball = prepare_surface(test::sphere(0.5, 2));
    for (const bool is_replaced : {false, true, false}) {
        auto opened = std::async(std::launch::async,
                                 [&] { return open_shared_gpu(gpu.address(), 8, "why"); });
        while (opened.wait_for(std::chrono::milliseconds(5)) != std::future_status::ready)
            gpu.tend();
        const auto backend = opened.get();
        CHECK(backend->info().name == "stand-in");
        CHECK(backend->info().reason == "why");
        CHECK_THROWS_WITH_AS(backend->prepare(ball.surface), doctest::Contains("has ended"),
                             GlError);
        if (is_replaced) gpu.replace_if_hung();
    }
    const std::string gone = gpu.address() + "x";
    CHECK_THROWS_AS(open_shared_gpu(gone, 8, ""), GlError);
}

TEST_CASE("record: what is written is read; what is torn is nothing") {
    Record record = made("o", Status::Warned);
    record.warnings = {"a \"b\"\n"};
    record.seconds = 0.25;
    record.peak_memory_kib = 12;
    record.thumbnail = "QUJD";
    const std::string line = to_line(record);
    CHECK(line.find('\n') == std::string::npos);
    const auto back = parse_record(line);
    REQUIRE(back);
    CHECK(to_line(*back) == line);
    CHECK(back->warnings == record.warnings);
    for (std::size_t size = 0; size < line.size(); ++size)
        CHECK(!parse_record(std::string_view(line).substr(0, size)));
    CHECK(!parse_record("{\"status\": \"odd\"}"));
}

TEST_CASE("journal: the last line of an output counts, and a torn one is cut off") {
    const Folder folder;
    const std::string path = folder.at("j.jsonl");
    {
        Journal journal(path);
        CHECK(journal.find("a") == nullptr);
        journal.append(made("a", Status::Failed));
        journal.append(made("b", Status::Ok));
        journal.append(made("a", Status::Ok, "new"));
        journal.append(made("\xff", Status::Ok));
        journal.flush();
    }
    std::ofstream(path, std::ios::app) << "no record\n{\"model\": \"tor";
    const auto torn = fs::file_size(path);
    Journal journal(path);
    CHECK(fs::file_size(path) < torn);
    CHECK(journal.strange_lines() == 1);
    const std::string half = folder.at("half.jsonl");
    std::ofstream(half) << "{\"model\":\"a";
    CHECK(Journal(half).strange_lines() == 0);
    CHECK(fs::file_size(half) == 0);
    for (const char* other : {"a list\n", "solid cube", "{\"models\": 1}\n"}) {
        const std::string name = folder.at("other");
        std::ofstream(name) << other;
        CHECK_THROWS_WITH_AS(Journal{name}, doctest::Contains("is no journal"), UsageError);
        CHECK(fs::file_size(name) == std::string_view(other).size());
    }
    REQUIRE(journal.find("a") != nullptr);
    CHECK(journal.find("a")->key == "new");
    CHECK(journal.find("b")->status == Status::Ok);
    CHECK(journal.find("\xff") != nullptr);
}

TEST_CASE("journal: a place that cannot be one is an error that names it") {
    const Folder folder;
    CHECK_THROWS_WITH_AS(Journal(folder.at("no/j.jsonl")), doctest::Contains("no/j.jsonl"),
                         IoError);
    CHECK_THROWS_AS(Journal("/dev/null"), UsageError);
}

TEST_CASE("remove_stale_files: of these outputs, and of processes that are no more") {
    const Folder folder;
    const pid_t gone = ::fork();
    if (gone == 0) ::_exit(0);
    // It has ended and nobody has asked how: a zombie does not run.
    while (is_running(gone)) ::usleep(1000);
    const std::string output = folder.at("a.json");
    const std::string other = folder.at("b.json");
    for (const fs::path& path : {temporary_path(output, gone), temporary_path(other, gone),
                                 temporary_path(output, ::getpid())})
        std::ofstream(path) << "half";
    CHECK(remove_stale_files({{0, "m", output}}) == 1);
    CHECK(!fs::exists(temporary_path(output, gone)));
    CHECK(fs::exists(temporary_path(other, gone)));
    CHECK(fs::exists(temporary_path(output, ::getpid())));
    remove_stale_file(other, gone);
    CHECK(!fs::exists(temporary_path(other, gone)));
}

TEST_CASE("WorkerPool: a crash, a kill, a hang cost their item and no other") {
    WorkerPool pool({1, 0.0}, play_worker);
    CHECK(result_of(pool, "a").status == Status::Ok);
    const Record crash = result_of(pool, "crash");
    CHECK(crash.status == Status::Failed);
    CHECK(crash.reason == "crashed");
    CHECK(crash.exit_code == 128 + SIGABRT);
    CHECK(crash.key == "k");
    CHECK(crash.backend == "none");
    CHECK(crash.model == "crash");
    CHECK(crash.output == "crash.json");
    CHECK(result_of(pool, "kill").exit_code == 128 + SIGKILL);
    CHECK(result_of(pool, "leave").exit_code == 9);
    CHECK(result_of(pool, "b").status == Status::Ok);

    WorkerPool impatient({1, 0.05}, play_worker);
    const Record late = result_of(impatient, "hang");
    CHECK(late.reason == "timeout");
    CHECK(late.exit_code == static_cast<int>(ExitCode::Limit));
    CHECK(result_of(impatient, "c").model == "c");
}

TEST_CASE("WorkerPool: want of memory in a used worker is tried again in a fresh one") {
    WorkerPool pool({1, 0.0}, play_worker);
    CHECK(result_of(pool, "a").status == Status::Ok);
    CHECK(result_of(pool, "fresh").status == Status::Ok);
}

TEST_CASE("run_items: every item is accounted for, and a second run has nothing to do") {
    const Folder folder;
    std::vector<Item> items;
    for (const char* model : {"a", "crash", "b", "c"})
        items.push_back({items.size(), model, folder.at(std::string(model) + ".json")});
    Journal journal(folder.at("j.jsonl"));
    RunOptions options;
    options.pool.workers = 2;
    const Tally tally = run_items(items, options, journal, play_worker).tally;
    CHECK(tally.items == 4);
    CHECK(tally.ok == 3);
    CHECK(tally.failed == 1);
    CHECK(tally.left == 0);
    CHECK(tally.reasons.at("crashed") == 1);
    for (const Item& item : items) CHECK(journal.find(item.output) != nullptr);
}

TEST_CASE("run_items: a signal stops it, and what is in work is as if it had never begun") {
    const Folder folder;
    const std::vector<Item> items{
        {0, "a", folder.at("a")}, {1, "hang", folder.at("hang")}, {2, "b", folder.at("b")}};
    Journal journal(folder.at("j.jsonl"));
    const pid_t parent = ::getpid();
    const pid_t killer = ::fork();
    if (killer == 0) {
        ::usleep(300000);
        ::kill(parent, SIGTERM);
        ::_exit(0);
    }
    struct sigaction before {};
    std::signal(SIGTERM, SIG_DFL);
    const RunResult result = run_items(items, {}, journal, play_worker);
    ::sigaction(SIGTERM, nullptr, &before);
    CHECK((before.sa_handler == SIG_DFL));
    CHECK(result.signal == SIGTERM);
    CHECK(result.tally.ok == 1);
    CHECK(result.tally.left == 2);
    CHECK(journal.find(items[1].output) == nullptr);
}

TEST_CASE("tally: items = ok + warned + failed + skipped, old failures among the failed") {
    Tally tally;
    tally.items = 5;
    const Record old_failure = made("e", Status::Failed);
    for (const Status status : {Status::Ok, Status::Warned, Status::Failed, Status::Skipped})
        tally.add(made("x", status), nullptr);
    tally.add(made("e", Status::Skipped), &old_failure);
    CHECK(tally.done() == 5);
    CHECK(tally.failed == 2);
    CHECK(tally.failed_before == 1);
    CHECK(tally.worked_on() == 3);
    CHECK(tally.reasons.at("bad_input") == 2);
    CHECK(summary_text(tally).starts_with("5 items = 1 ok + 1 warned + 2 failed + 1 skipped\n"));
    CHECK(summary_json(tally).find("\"failed_before\": 1") != std::string::npos);
}

TEST_CASE("progress_text: share, rate and time left") {
    Tally tally;
    tally.items = 100;
    tally.ok = 20;
    tally.skipped = 5;
    tally.failed = 5;
    CHECK(progress_text(tally, 10.0) ==
          "[#########                     ] 30/100 30 %, 2.5/s, 0:00:28 left, 5 failed");
    CHECK(progress_text({}, 0.0).find("100 %") != std::string::npos);
}

TEST_CASE("report_page: failures first, names escaped, pictures within") {
    const Folder folder;
    Journal journal(folder.at("j.jsonl"));
    Record ok = made("a", Status::Ok);
    ok.model = "<a>.obj";
    ok.thumbnail = "QUJD";
    Record failed = made("b", Status::Failed);
    failed.no_thumbnail = "no GL";
    journal.append(ok);
    journal.append(failed);
    const std::string page =
        report_page({{0, "<a>.obj", "a"}, {1, "m.obj", "b"}, {2, "never", "c"}}, journal, {});
    CHECK(page.find("class=\"failed\"") < page.find("class=\"ok\""));
    CHECK(page.find("&lt;a&gt;.obj") != std::string::npos);
    CHECK(page.find("data:image/png;base64,QUJD") != std::string::npos);
    CHECK(page.find("no GL") != std::string::npos);
}

TEST_CASE("item_key: of the bytes, the options, the form and the backend that answers") {
    Task task;
    const std::string key = item_key("bytes", task, SkeletonFormat::Json, "cpu");
    CHECK(item_key("bytes", task, SkeletonFormat::Json, "cpu") == key);
    CHECK(item_key("other", task, SkeletonFormat::Json, "cpu") != key);
    CHECK(item_key("bytes", task, SkeletonFormat::Swc, "cpu") != key);
    CHECK(item_key("bytes", task, SkeletonFormat::Json, "ray") != key);
    task.backend.kind = BackendKind::Cpu;
    CHECK(item_key("bytes", task, SkeletonFormat::Json, "cpu") == key);
    task.extract.newton.limbs.detail = 2.0;
    CHECK(item_key("bytes", task, SkeletonFormat::Json, "cpu") != key);
}

TEST_CASE("look_at_machine: a container's bounds count, and its workers fit") {
    const Folder root;
    root.put("proc/meminfo", "MemTotal: 9000000 kB\nMemAvailable: 8388608 kB\n");
    Machine machine = look_at_machine(root.path);
    CHECK(machine.memory_bytes == std::size_t{8} << 30);
    CHECK(!machine.has_gpu);
    root.put("sys/fs/cgroup/cpu.max", "100000 100000\n");
    root.put("sys/fs/cgroup/memory.max", "1073741824\n");
    root.put("dev/nvidia0", "");
    machine = look_at_machine(root.path);
    CHECK(machine.cores == 1);
    CHECK(machine.memory_bytes == std::size_t{1} << 30);
    CHECK(machine.has_gpu);
    root.put("sys/fs/cgroup/memory.max", "max\n");
    CHECK(look_at_machine(root.path).memory_bytes == std::size_t{8} << 30);
    CHECK(recommended_workers({16, std::size_t{1} << 30, false}) == 4);
    CHECK(recommended_workers({2, 0, false}) == 2);
    CHECK(recommended_workers({4, 1000, false}) == 1);
    CHECK(memory_for_worker({4, 1000, false}, 3) == 300);
}
