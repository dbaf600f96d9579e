#include "viz/vtk_module/vtk_files.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>
#include <hdf5.h>
#include <vtkCellType.h>
#include <vtkDataSetAttributes.h>

#include "core/error.h"

namespace clsurf::viz::vtk_module {
namespace {

/// An attribute of pieces: the first and the last of its own points, and the number of points of the surface.
constexpr const char* own_points_attribute = "clsurf_points";
constexpr const char* ghost_column = "vtkGhostType";

using Sizes = std::vector<hsize_t>;

/// An HDF5 object that closes itself.
class H5 {
public:
    H5(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
    H5(const H5&) = delete;
    H5& operator=(const H5&) = delete;
    H5(H5&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
    H5& operator=(H5&&) = delete;
    ~H5() {
        if (id_ >= 0) close_(id_);
    }
    [[nodiscard]] hid_t id() const { return id_; }

private:
    hid_t id_;
    herr_t (*close_)(hid_t);
};

H5 written(hid_t id, herr_t (*close)(hid_t), const std::string& what) {
    if (id < 0) throw SystemError("HDF5 cannot write: " + what);
    return {id, close};
}

hid_t type_of(float) { return H5T_NATIVE_FLOAT; }
hid_t type_of(double) { return H5T_NATIVE_DOUBLE; }
hid_t type_of(std::uint32_t) { return H5T_NATIVE_UINT32; }
hid_t type_of(std::int64_t) { return H5T_NATIVE_INT64; }
hid_t type_of(std::uint8_t) { return H5T_NATIVE_UINT8; }

/// Turns off HDF5's error output: failures are reported once, by exceptions.
void be_quiet() {
    H5dont_atexit();  // closing again after a full disk would crash
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

H5 make_set(hid_t group, const std::string& name, hid_t type, const Sizes& size) {
    const H5 space = written(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), H5Sclose, name);
    // Without a time stamp, so that the same export gives the same file.
    const H5 how = written(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, name);
    if (H5Pset_obj_track_times(how.id(), false) < 0) throw SystemError("HDF5 cannot write " + name);
    return written(H5Dcreate2(group, name.c_str(), type, space.id(), H5P_DEFAULT, how.id(), H5P_DEFAULT), H5Dclose,
                   name);
}

template <typename T>
void put(hid_t group, const std::string& name, const Sizes& size, const T* values) {
    const H5 set = make_set(group, name, type_of(T()), size);
    if (H5Dwrite(set.id(), type_of(T()), H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
        throw SystemError("HDF5 cannot write " + name);
}

template <typename T>
void put(hid_t group, const std::string& name, const Column<T>& values) {
    put(group, name, {values.size()}, values.data());
}

void put_attribute(hid_t object, const char* name, const std::vector<std::int64_t>& numbers) {
    const hsize_t count = numbers.size();
    const H5 space = written(H5Screate_simple(1, &count, nullptr), H5Sclose, name);
    const H5 attribute =
        written(H5Acreate2(object, name, H5T_NATIVE_INT64, space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose, name);
    if (H5Awrite(attribute.id(), H5T_NATIVE_INT64, numbers.data()) < 0)
        throw SystemError("HDF5 cannot write attributes");
}

void put_header(hid_t group) {
    put_attribute(group, "Version", {1, 0});
    const H5 scalar = written(H5Screate(H5S_SCALAR), H5Sclose, "Type");
    const H5 text = written(H5Tcopy(H5T_C_S1), H5Tclose, "Type");
    const char type[] = "UnstructuredGrid";
    H5Tset_size(text.id(), sizeof type - 1);
    const H5 kind =
        written(H5Acreate2(group, "Type", text.id(), scalar.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose, "Type");
    if (H5Awrite(kind.id(), text.id(), type) < 0) throw SystemError("HDF5 cannot write attributes");
}

/// A file with the group VTKHDF and the group of point data.
struct OutputFile {
    explicit OutputFile(const std::string& path)
        : access(stdio_access()),
          file(written(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), H5Fclose, path)),
          root(group_in(file, "VTKHDF")) {
        put_header(root.id());
    }
    [[nodiscard]] H5 point_data() const { return group_in(root, "PointData"); }
    /// Closing also writes, but its failures are not reported.
    void flush() const {
        if (H5Fflush(file.id(), H5F_SCOPE_LOCAL) < 0) throw SystemError("HDF5 cannot write: the disk is full?");
    }

    H5 access, file, root;

private:
    static H5 group_in(const H5& parent, const char* name) {
        return written(H5Gcreate2(parent.id(), name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, name);
    }
    /// The default driver resolves the real path of links, which the unnamed file of an io::AtomicFile does not have.
    static H5 stdio_access() {
        be_quiet();
        H5 made = written(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "access");
        H5Pset_fapl_stdio(made.id());
        return made;
    }
};

/// Moves the cells out of the piece.
void put_piece(const OutputFile& out, VtkPiece& piece, const std::vector<PointData>& data, bool marks_ghosts) {
    Column<std::int64_t> connectivity = std::move(piece.line_points);
    Column<std::int64_t> offsets = std::move(piece.line_offsets);
    Column<std::uint8_t> types(offsets.size() - 1, VTK_POLY_LINE);
    for (std::size_t t = 0; t < piece.triangles.size(); ++t) {
        connectivity.push_back(piece.triangles[t]);
        if (t % 3 != 2) continue;
        offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
        types.push_back(VTK_TRIANGLE);
    }
    const std::size_t count = piece.xyz.size() / 3;
    const auto put_count = [&](const char* name, std::size_t n) {
        const auto number = static_cast<std::int64_t>(n);
        put(out.root.id(), name, {1}, &number);
    };
    put_count("NumberOfPoints", count);
    put_count("NumberOfCells", types.size());
    put_count("NumberOfConnectivityIds", connectivity.size());
    put(out.root.id(), "Points", {count, 3}, piece.xyz.data());
    put(out.root.id(), "Connectivity", connectivity);
    put(out.root.id(), "Offsets", offsets);
    put(out.root.id(), "Types", types);
    const H5 point_data = out.point_data();
    for (const PointData& column : data)
        std::visit([&](const auto* values) { put(point_data.id(), column.name, *values); }, column.values);
    if (!marks_ghosts) return;
    Column<std::uint8_t> marks(count, 0);
    for (auto k = static_cast<std::size_t>(piece.own_points); k < count; ++k)
        marks[k] = vtkDataSetAttributes::DUPLICATEPOINT;
    put(point_data.id(), ghost_column, marks);
}

/// A data set of a piece.
struct SetInfo {
    std::string name;
    Sizes size;
};

/// Reads a file of write_vtkhdf() for merge_vtkhdf().
class PieceFile {
public:
    explicit PieceFile(const std::string& path)
        : path_(path),
          file_(read(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose)),
          root_(read(H5Gopen2(file_.id(), "VTKHDF", H5P_DEFAULT), H5Gclose)),
          data_(read(H5Gopen2(root_.id(), "PointData", H5P_DEFAULT), H5Gclose)) {
        const H5 attribute = read(H5Aopen(file_.id(), own_points_attribute, H5P_DEFAULT), H5Aclose);
        const H5 space = read(H5Aget_space(attribute.id()), H5Sclose);
        std::array<std::int64_t, 3> numbers{};
        if (H5Sget_simple_extent_npoints(space.id()) != 3 ||
            H5Aread(attribute.id(), H5T_NATIVE_INT64, numbers.data()) < 0)
            refuse();
        own = {numbers[0], numbers[1]};
        of = numbers[2];
        points = count("NumberOfPoints");
        cells = count("NumberOfCells");
        ids = count("NumberOfConnectivityIds");
        check(root_, "Points", {points, 3});
        check(root_, "Connectivity", {ids});
        check(root_, "Offsets", {cells + 1});
        check(root_, "Types", {cells});
        H5G_info_t info{};
        if (H5Gget_info(data_.id(), &info) < 0) refuse();
        for (hsize_t k = 0; k < info.nlinks; ++k) {
            columns.push_back(name_of(k));
            check(data_, columns.back(), {points});
        }
    }

    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] hid_t root() const { return root_.id(); }
    [[nodiscard]] hid_t data() const { return data_.id(); }

    /// Whether both have the same columns with the same types.
    [[nodiscard]] bool has_columns_of(const PieceFile& other) const {
        return columns == other.columns && std::ranges::all_of(columns, [&](const std::string& name) {
                   return H5Tequal(type(name).id(), other.type(name).id()) > 0;
               });
    }
    /// The type of a column of point data.
    [[nodiscard]] H5 type(const std::string& name) const {
        const H5 set = open(data_, name);
        return read(H5Dget_type(set.id()), H5Tclose);
    }
    [[nodiscard]] H5 set(hid_t group, const std::string& name) const {
        return read(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose);
    }
    [[noreturn]] void refuse() const {
        throw InputError(Place::of_file(path_),
                         "is not a .vtkhdf piece that clsurf export --shard writes, or is damaged");
    }

    PointRange own;
    PointIndex of = 0;  ///< points of the surface
    hsize_t points = 0, cells = 0, ids = 0;
    std::vector<std::string> columns;  ///< by name

private:
    [[nodiscard]] H5 read(hid_t id, herr_t (*close)(hid_t)) const {
        if (id < 0) refuse();
        return {id, close};
    }
    [[nodiscard]] H5 open(const H5& group, const std::string& name) const { return set(group.id(), name); }

    [[nodiscard]] std::string name_of(hsize_t number) const {
        const auto get = [&](char* text, std::size_t size) {
            return H5Lget_name_by_idx(data_.id(), ".", H5_INDEX_NAME, H5_ITER_INC, number, text, size, H5P_DEFAULT);
        };
        const ssize_t length = get(nullptr, 0);
        if (length < 0) refuse();
        std::string name(static_cast<std::size_t>(length), '\0');
        (void)get(name.data(), name.size() + 1);
        return name;
    }

    void check(const H5& group, const std::string& name, const Sizes& size) const {
        const H5 set = open(group, name);
        const H5 space = read(H5Dget_space(set.id()), H5Sclose);
        Sizes found(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space.id()))));
        if (found.size() != size.size() || H5Sget_simple_extent_dims(space.id(), found.data(), nullptr) < 0 ||
            found != size)
            refuse();
    }
    [[nodiscard]] hsize_t count(const char* name) const {
        check(root_, name, {1});
        std::int64_t number = -1;
        if (H5Dread(open(root_, name).id(), H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, &number) < 0 || number < 0)
            refuse();
        return static_cast<hsize_t>(number);
    }

    std::string path_;
    H5 file_, root_, data_;
};

/// The points, cells and connectivity of all pieces before one.
struct Totals {
    hsize_t points = 0, cells = 0, ids = 0, partitions = 0;
    void add(const PieceFile& piece) {
        points += piece.points;
        cells += piece.cells;
        ids += piece.ids;
        ++partitions;
    }
};

/// Copies the rows of a data set of a piece into one of all pieces, from row `to` on.
class RowCopier {
public:
    void copy(const PieceFile& piece, const H5& from, const H5& into, hid_t type, std::size_t rows, hsize_t wide,
              hsize_t to) {
        constexpr hsize_t rows_at_once = 1 << 20;
        const std::size_t row_bytes = H5Tget_size(type) * wide;
        for (hsize_t first = 0; first < rows; first += rows_at_once) {
            const hsize_t count = std::min<hsize_t>(rows_at_once, rows - first);
            bytes_.resize(count * row_bytes);
            const H5 memory = rows_of(nullptr, 0, count, wide);
            const H5 source = rows_of(&from, first, count, wide);
            if (H5Dread(from.id(), type, memory.id(), source.id(), H5P_DEFAULT, bytes_.data()) < 0) piece.refuse();
            const H5 target = rows_of(&into, to + first, count, wide);
            if (H5Dwrite(into.id(), type, memory.id(), target.id(), H5P_DEFAULT, bytes_.data()) < 0)
                throw SystemError("HDF5 cannot write: the disk is full?");
        }
    }

private:
    /// Some rows of a data set, or a space of that size in memory.
    static H5 rows_of(const H5* set, hsize_t first, hsize_t count, hsize_t wide) {
        const int rank = wide > 1 ? 2 : 1;
        const std::array<hsize_t, 2> start{first, 0}, size{count, wide};
        if (set == nullptr) return written(H5Screate_simple(rank, size.data(), nullptr), H5Sclose, "rows");
        H5 space = written(H5Dget_space(set->id()), H5Sclose, "rows");
        H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, start.data(), nullptr, size.data(), nullptr);
        return space;
    }

    std::vector<std::byte> bytes_;
};

/// The pieces in the order of their points. Checks that all columns are equal and every point occurs once.
std::vector<std::string> in_order(const std::vector<std::string>& pieces, Totals& all) {
    struct Known {
        std::string path;
        PointRange own;
    };
    std::vector<Known> known;
    const PieceFile first(pieces.front());
    for (const std::string& path : pieces) {
        const PieceFile piece(path);
        if (!piece.has_columns_of(first) || piece.of != first.of) {
            throw InputError(Place::of_file(path), piece.of != first.of
                                                       ? "belongs to a different surface from that of " + pieces.front()
                                                       : "has different columns from " + pieces.front());
        }
        all.add(piece);
        known.push_back({path, piece.own});
    }
    std::ranges::sort(known, {}, [](const Known& piece) { return piece.own.first; });
    std::vector<std::string> ordered;
    PointIndex next = 0;
    const auto refuse = [](PointIndex from, PointIndex to) {
        throw UsageError(fmt::format("points {} … {} are in none of the pieces", from, to - 1));
    };
    for (const Known& piece : known) {
        if (piece.own.first < next)
            throw UsageError(fmt::format("points {} … {} are in two of the pieces", piece.own.first, next - 1));
        if (piece.own.first > next) refuse(next, piece.own.first);
        next = piece.own.last + 1;
        ordered.push_back(piece.path);
    }
    if (next != first.of) refuse(next, first.of);
    return ordered;
}

}  // namespace

void write_vtkhdf(const std::string& path, VtkPiece& whole, const std::vector<PointData>& data) {
    const OutputFile out(path);
    put_piece(out, whole, data, false);
    out.flush();
}

void write_vtkhdf_piece(const std::string& path, VtkPiece& piece, const PointRange& own, PointIndex points,
                        const std::vector<PointData>& data) {
    const OutputFile out(path);
    put_attribute(out.file.id(), own_points_attribute, {own.first, own.last, points});
    put_piece(out, piece, data, true);
    out.flush();
}

void merge_vtkhdf(const std::string& path, const std::vector<std::string>& pieces) {
    be_quiet();
    Totals all;
    const std::vector<std::string> ordered = in_order(pieces, all);
    const PieceFile first(ordered.front());
    const OutputFile out(path);
    struct Target {
        const char* name;
        hid_t type;
        hsize_t Totals::*before;  ///< rows of the previous pieces
        hsize_t more, wide;       ///< additional rows per piece
        H5 set;
    };
    std::vector<Target> targets;
    const auto add = [&](const char* name, hid_t type, hsize_t Totals::*rows, hsize_t more, hsize_t wide) {
        Sizes size{all.*rows + more * all.partitions};
        if (wide > 1) size.push_back(wide);
        targets.push_back({name, type, rows, more, wide, make_set(out.root.id(), name, type, size)});
    };
    for (const char* name : {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"})
        add(name, H5T_NATIVE_INT64, &Totals::partitions, 0, 1);
    add("Points", H5T_NATIVE_DOUBLE, &Totals::points, 0, 3);
    add("Connectivity", H5T_NATIVE_INT64, &Totals::ids, 0, 1);
    add("Offsets", H5T_NATIVE_INT64, &Totals::cells, 1, 1);
    add("Types", H5T_NATIVE_UINT8, &Totals::cells, 0, 1);
    const H5 point_data = out.point_data();
    std::vector<H5> columns;
    for (const std::string& name : first.columns)
        columns.push_back(make_set(point_data.id(), name, first.type(name).id(), {all.points}));
    RowCopier copier;
    Totals before;
    for (const std::string& name : ordered) {
        const PieceFile piece(name);
        Totals after = before;
        after.add(piece);
        for (const Target& target : targets) {
            const hsize_t from = before.*target.before + target.more * before.partitions;
            const hsize_t to = after.*target.before + target.more * after.partitions;
            copier.copy(piece, piece.set(piece.root(), target.name), target.set, target.type, to - from, target.wide,
                        from);
        }
        for (std::size_t k = 0; k < columns.size(); ++k)
            copier.copy(piece, piece.set(piece.data(), piece.columns[k]), columns[k], piece.type(piece.columns[k]).id(),
                        piece.points, 1, before.points);
        before = after;
    }
    out.flush();
}

}  // namespace clsurf::viz::vtk_module
