// Refusals: content that does not fit together, a driver without memory, shaders that do not compile.
#include <gtest/gtest.h>

#include <epoxy/gl.h>

#include <cstdlib>
#include <fstream>

#include "draw/compile_shaders.h"
#include "draw/draw_world.h"
#include "worlds/scratch_folder.h"

namespace fb::draw_test {

namespace {

// Stands in for the driver's allocations: the n-th one, and all after it, find no memory. libepoxy calls
// OpenGL through pointers that may be exchanged.
class NoMemoryFrom {
  public:
    explicit NoMemoryFrom(int call) {
        left = call - 1;
        pending = GL_NO_ERROR;
        realBuffer = std::exchange(epoxy_glNamedBufferStorage,
                                   [](GLuint name, GLsizeiptr size, const void* data, GLbitfield flags) {
                                       if (allowed()) realBuffer(name, size, data, flags);
                                   });
        real2D = std::exchange(epoxy_glTextureStorage2D,
                               [](GLuint name, GLsizei levels, GLenum format, GLsizei w, GLsizei h) {
                                   if (allowed()) real2D(name, levels, format, w, h);
                               });
        real3D = std::exchange(epoxy_glTextureStorage3D, [](GLuint name, GLsizei levels, GLenum format,
                                                            GLsizei w, GLsizei h, GLsizei d) {
            if (allowed()) real3D(name, levels, format, w, h, d);
        });
        realError = std::exchange(epoxy_glGetError, [] {
            return pending != GL_NO_ERROR ? std::exchange(pending, GLenum{GL_NO_ERROR}) : realError();
        });
    }
    ~NoMemoryFrom() {
        epoxy_glNamedBufferStorage = realBuffer;
        epoxy_glTextureStorage2D = real2D;
        epoxy_glTextureStorage3D = real3D;
        epoxy_glGetError = realError;
    }
    NoMemoryFrom(const NoMemoryFrom&) = delete;
    NoMemoryFrom& operator=(const NoMemoryFrom&) = delete;

  private:
    static bool allowed() {
        if (left-- > 0) return true;
        pending = GL_OUT_OF_MEMORY;
        return false;
    }
    inline static int left = 0;
    inline static GLenum pending = GL_NO_ERROR;
    inline static decltype(epoxy_glNamedBufferStorage) realBuffer = nullptr;
    inline static decltype(epoxy_glTextureStorage2D) real2D = nullptr;
    inline static decltype(epoxy_glTextureStorage3D) real3D = nullptr;
    inline static decltype(epoxy_glGetError) realError = nullptr;
};

DecodedNode texturedNode(float left) {
    DecodedNode node;
    addTexturedQuad(node, rectangle(left, -4, left + 4, 4, -4));
    setTexture(node, 8, 8, manyColours(8, 8));
    return node;
}

// A copy of the shaders in which a file can be spoilt; removed in the end.
class SpoiltShaders {
  public:
    SpoiltShaders() { std::filesystem::copy(kShaders, folder, std::filesystem::copy_options::recursive); }

    // Returns the number of the line.
    int insertBefore(const std::string& file, const std::string& start, const std::string& text) const {
        std::ifstream in(folder / file);
        std::string line, all;
        int number = 0, found = 0;
        while (std::getline(in, line)) {
            ++number;
            if (found == 0 && line.starts_with(start)) {
                found = number;
                all += text + "\n";
            }
            all += line + "\n";
        }
        in.close();
        std::ofstream(folder / file) << all;
        return found;
    }

  private:
    ScratchFolder scratch_;

  public:
    const std::filesystem::path folder = scratch_.path();
};

}  // namespace

TEST_F(DrawTest, RefusesANodeThatDoesNotFitTogether) {
    const DecodedNode good = texturedNode(-4);
    const auto reasonFor = [&](auto spoil) {
        DecodedNode bad = good;
        spoil(bad);
        const auto uploaded = renderer->upload(5, bad);
        return uploaded ? std::string("accepted") : uploaded.error().oneLine();
    };
    EXPECT_EQ(reasonFor([](DecodedNode&) {}), "accepted");
    renderer->release(5);
    EXPECT_EQ(reasonFor([](DecodedNode& n) { n.indices[3] = 4; }), "node 5: index 4 of 4 vertices");
    EXPECT_EQ(reasonFor([](DecodedNode& n) { n.indices.pop_back(); }), "node 5: 5 indices for 2 triangles");
    EXPECT_EQ(reasonFor([](DecodedNode& n) { n.texturedTriangles = 0xffffffff; }),
              "node 5: 6 indices for 4294967295 triangles");
    EXPECT_EQ(reasonFor([](DecodedNode& n) { n.textureWidth = 0; }),
              "node 5: a texture with one side of 0 texels");
    EXPECT_EQ(reasonFor([](DecodedNode& n) { n.textureWidth = n.textureHeight = 0; }),
              "node 5: textured triangles without a texture");
    EXPECT_EQ(reasonFor([](DecodedNode& n) { n.texels.pop_back(); }),
              "node 5: 339 bytes of texels instead of 340");
    EXPECT_EQ(reasonFor([](DecodedNode& n) { n.mipLevels = 1; }), "node 5: 1 mip levels instead of 4");
    const GpuMemory memory = renderer->memory();
    EXPECT_EQ(
        memory.meshBytes + memory.textureBytes + memory.allocatedMeshBytes + memory.allocatedTextureBytes,
        0u);
}

TEST_F(DrawTest, RefusesATextureLargerThanTheDriverTakes) {
    DecodedNode node = texturedNode(-4);
    node.textureWidth = 40'000;
    node.textureHeight = 4;
    node.mipLevels = mipLevelCount(40'000, 4);
    node.texels.assign(mippedBytes(40'000, 4), 0);
    const auto uploaded = renderer->upload(0, node);
    ASSERT_FALSE(uploaded);
    EXPECT_NE(uploaded.error().oneLine().find("40000 x 4"), std::string::npos) << uploaded.error().oneLine();
    EXPECT_EQ(renderer->memory().allocatedMeshBytes, 0u);
}

TEST_F(DrawTest, TakesANodeWithoutTriangles) {
    World world;
    world.add({});
    world.uploadAll(*renderer);
    settings.boxes = settings.wireframe = true;
    picture(world, viewAlongZ({}, 8, 8));
    EXPECT_EQ(counters.nodes, 1u);
    EXPECT_EQ(counters.triangles, 0u);
    renderer->release(0);
}

// The second node needs a mesh page and a texture page: the first allocation without memory is one, then the
// other, then neither. What was there stays, and the node can be uploaded later.
TEST_F(DrawTest, StaysAsItWasWhenAnUploadFindsNoMemory) {
    World world;
    world.add(texturedNode(-4));
    world.add(texturedNode(0));
    effects[Effect::texturing] = true;
    RendererOptions options;
    options.meshPageBytes = options.largestTexturePageBytes = options.smallestTexturePageBytes = 1;
    const View view = viewAlongZ({}, 8, 8);
    int refusals = 0;
    for (int call = 1; call <= 4; ++call) {
        remake(options);
        ASSERT_TRUE(renderer->upload(0, world.contents[0]));
        const Image before = picture(world, view);
        const GpuMemory memory = renderer->memory();
        {
            const NoMemoryFrom driver(call);
            const auto uploaded = renderer->upload(1, world.contents[1]);
            if (uploaded) continue;
            EXPECT_EQ(uploaded.error().place, "node 1");
            EXPECT_NE(uploaded.error().reason.find("out of memory"), std::string::npos);
            ++refusals;
        }
        EXPECT_EQ(renderer->memory().meshBytes, memory.meshBytes);
        EXPECT_EQ(renderer->memory().textureBytes, memory.textureBytes);
        EXPECT_EQ(renderer->memory().allocatedMeshBytes, memory.allocatedMeshBytes);
        EXPECT_EQ(renderer->memory().allocatedTextureBytes, memory.allocatedTextureBytes);
        EXPECT_EQ(picture(world, view).pixels, before.pixels);
        ASSERT_TRUE(renderer->upload(1, world.contents[1]));
        EXPECT_NE(picture(world, view).pixels, before.pixels);
    }
    EXPECT_EQ(refusals, 2);
}

TEST_F(DrawTest, KeepsItsPictureWhenALargerOneFindsNoMemory) {
    World world;
    world.add(colouredRectangle(-100, -100, 100, 100, -4, kRed));
    world.uploadAll(*renderer);
    const Image before = picture(world, viewAlongZ({}, 8, 8));
    int refusals = 0;
    for (int call = 1; call <= 3; ++call) {
        const NoMemoryFrom driver(call);
        renderer->draw({world.hierarchy, world.front, viewAlongZ({}, 9, 9), settings, effects}, 2);
        if (renderer->fault().empty()) continue;
        ++refusals;
        EXPECT_NE(renderer->fault().find("9 x 9"), std::string::npos) << renderer->fault();
        EXPECT_EQ(renderer->readPicture().pixels, before.pixels);
    }
    EXPECT_EQ(refusals, 2);  // colour, depth
    EXPECT_EQ(count(picture(world, viewAlongZ({}, 9, 9)), kRed), 81);
}

TEST_F(DrawTest, SaysSoWhenTheFirstFrameFindsNoMemory) {
    const World world;
    {
        const NoMemoryFrom driver(3);  // after colour and depth: the frame's data
        renderer->draw({world.hierarchy, world.front, viewAlongZ({}, 8, 8), settings, effects}, 1);
        EXPECT_NE(renderer->fault().find("out of memory"), std::string::npos) << renderer->fault();
    }
    picture(world, viewAlongZ({}, 8, 8));
    EXPECT_EQ(renderer->fault(), "");
}

TEST_F(DrawTest, NamesFileAndLineOfAShaderThatDoesNotCompile) {
    for (const auto& [file, start] : {std::pair{"node.frag", "void main"},
                                      {"light.glsl", "float brightness"},
                                      {"wire.vert", "void main"},
                                      {"shared.h", "struct DrawData"}}) {
        const SpoiltShaders shaders;
        const int line = shaders.insertBefore(file, start, "vec3 broken = undeclared + 1.0;");
        ASSERT_GT(line, 1) << file;
        const auto made = Renderer::create(shaders.folder);
        ASSERT_FALSE(made) << file;
        EXPECT_EQ(made.error().file, (shaders.folder / file).string());
        EXPECT_EQ(made.error().place, "line " + std::to_string(line)) << made.error().oneLine();
    }
    messages.forget();  // some drivers send the compiler's messages as well
}

TEST_F(DrawTest, NamesAShaderThatIsMissing) {
    const SpoiltShaders shaders;
    std::filesystem::remove(shaders.folder / "light.glsl");
    const auto made = Renderer::create(shaders.folder);
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().file, (shaders.folder / "light.glsl").string());
    EXPECT_NE(made.error().hint.find("node.vert line 5"), std::string::npos) << made.error().oneLine();
}

TEST(ShaderError, IsReadFromEveryVendorsLog) {
    const ShaderText shader{"", {"a.vert", "b.glsl"}};
    const auto read = [&](std::string_view log) { return shaderError(shader, log).oneLine(); };
    const std::string says = ": the driver does not compile it: ";
    EXPECT_EQ(read("0:10012(5): error: `x' undeclared\n0:3(1): error"),
              "b.glsl: line 12" + says + "error: `x' undeclared");
    EXPECT_EQ(read("0(7) : error C1008: undefined x"), "a.vert: line 7" + says + "error C1008: undefined x");
    EXPECT_EQ(read("ERROR: 0:10040: 'x' : undeclared"), "b.glsl: line 40" + says + "'x' : undeclared");
    EXPECT_EQ(read("ERROR: 0:20040: of no file"), "a.vert" + says + "ERROR: 0:20040: of no file");
    for (const char* log : {"", "0:", "0(", "7", ": \n"}) EXPECT_TRUE(read(log).starts_with("a.vert")) << log;
}

TEST(GlMessages, HearsWhatTheDriverCallsAnError) {
    context();
    GlMessages messages;
    if (!messages.listening()) GTEST_SKIP() << "only contexts of debug builds send messages";
    glEnable(0xffff);
    glGetError();
    EXPECT_EQ(messages.errors().size(), 1u);
}

}  // namespace fb::draw_test
